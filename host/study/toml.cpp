// The TOML library itself, compiled here with the standard library's fast conversions of numbers:
// as Debian ships it, it makes a stream for each number, and a long axis takes four times as long.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
