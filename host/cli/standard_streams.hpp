// What the program prints. Its answers go to standard output, where none may be lost unnoticed; all
// else is told on standard error, and is never worth a run. Nothing else prints.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace gearsweep {

// Opens standard input, output and error where they are closed, so that no file gets the number of
// one of them and what is printed is written into it. Before anything else is opened. False when
// that is not possible.
bool open_standard_streams();

// Throw std::system_error when the text cannot be written, the second also for what was before.
void answer_text(std::string_view text);
void flush_answers();

// Whatever becomes of it. Waits while a pipe or a terminal takes nothing.
void tell_text(std::string_view text);
// Whether a short text would be taken at once.
bool is_heard();

enum class StandardStream : std::uint8_t { output, error };
// The columns of the terminal that shows the stream, 80 of one that does not say; nullopt where no
// terminal does.
std::optional<int> terminal_columns(StandardStream stream);

// What a terminal only shows. A control character may be an order to it, and names and texts in
// files are a stranger's choice: each but newline and tab becomes '?'.
std::string printable(std::string text);

template <class... Values>
void answer(fmt::format_string<Values...> format, Values&&... values) {
  answer_text(printable(fmt::format(format, std::forward<Values>(values)...)));
}

template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  tell_text(printable(fmt::format(format, std::forward<Values>(values)...)));
}

}  // namespace gearsweep
