#include "equations/detail/kernel_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/names.hpp"

namespace gearsweep {

std::string KernelText::state_index(std::size_t state) const {
  return "STATE_" + kernel_name(states_[state].name);
}

std::vector<Assignment> KernelText::places(const std::string& array,
                                           const std::vector<NodeId>& ids) const {
  std::vector<Assignment> made;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    made.emplace_back(fmt::format("{}[{}]", array, state_index(i)), ids[i]);
  }
  return made;
}

void KernelText::write_function(const std::string& name, const std::string& arguments,
                                const std::vector<Assignment>& assignments,
                                const std::string& unused, const std::string& before) {
  out += fmt::format("\nSHARED_FN void {}({}) {{\n", name, arguments);
  std::size_t begin = 0;
  while (begin < unused.size()) {
    const std::size_t end = std::min(unused.find(' ', begin), unused.size());
    out += fmt::format("  (void){};\n", unused.substr(begin, end - begin));
    begin = end + 1;
  }
  out += before + statements_of(*graph_, assignments, names) + "}\n";
}

void KernelText::write_list(const std::string& macro, const std::vector<std::string>& rows) {
  out += fmt::format("#define {}(X)", macro);
  for (const std::string& row : rows) out += fmt::format(" \\\n  X({})", row);
  out += "\n";
}

void KernelText::write_by_contact(const std::string& name, const std::string& parameters,
                                  const std::string& arguments,
                                  const std::vector<std::vector<Assignment>>& bodies) {
  std::string choice;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    write_function(fmt::format("{}{}", name, i), parameters, bodies[i], arguments);
    std::string list = arguments;
    for (std::size_t at = 0; (at = list.find(' ', at)) != std::string::npos; at += 2) {
      list.replace(at, 1, ", ");
    }
    choice += fmt::format("  if (contact == {}) {}{}({});\n", i, name, i, list);
  }
  std::string with_contact = parameters;
  with_contact.replace(with_contact.find("const real* x, "), 15, "const real* x, int contact, ");
  out += fmt::format("\nSHARED_FN void {}({}) {{\n{}}}\n", name, with_contact, choice);
}

}  // namespace gearsweep
