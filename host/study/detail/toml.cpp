// The TOML library itself, compiled here with the standard library's fast conversions of numbers:
// as Debian ships it, it makes a stream for each number, and a long axis takes four times as long.
//
// Its assertions are off, in every build. One of them is false for the header "[!]", which its
// parser goes on to refuse; with NDEBUG, clang would take it for a promise.
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
