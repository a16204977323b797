#include "cli/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "model/names.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

// Text that roff takes as it is.
std::string plain(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_line = i == 0 || text[i - 1] == '\n';
    if (starts_line && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\') {
      out += "\\e";
    } else if (text[i] == '-') {
      out += "\\-";
    } else if (text[i] == '\'') {
      out += "\\(aq";
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string bold(const std::string& text) { return fmt::format("\\fB{}\\fR", plain(text)); }
std::string italic(const std::string& text) { return fmt::format("\\fI{}\\fR", plain(text)); }

// Paragraphs as help shows them: lines that are indented stay as they are, others are filled.
std::string paragraphs(const std::string& text) {
  std::string out;
  bool in_example = false, in_paragraph = false;
  for (const std::string& line : split(text, '\n')) {
    const bool indented = line.rfind("  ", 0) == 0;
    if (in_example && !indented) out += ".RE\n.fi\n";
    if (!in_example && indented) out += ".PP\n.nf\n.RS\n";
    in_example = indented;
    if (!indented && !line.empty() && !in_paragraph) out += ".PP\n";
    in_paragraph = !indented && !line.empty();
    if (!line.empty()) out += plain(indented ? line.substr(2) : line) + "\n";
  }
  return in_example ? out + ".RE\n.fi\n" : out;
}

// A heading begins a paragraph by itself.
std::string section(const std::string& title, const std::string& text) {
  const std::string_view begin = ".PP\n";
  const bool has_begin = text.rfind(begin, 0) == 0;
  return fmt::format(".SH {}\n{}", title, text.substr(has_begin ? begin.size() : 0));
}

std::string option_text(const OptionEntry& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back(option.is_positional ? italic(name) : bold(name));
  }
  std::string text = fmt::format(".TP\n{}", fmt::join(names, ", "));
  if (!option.value.empty() && !option.is_positional) text += " " + italic(option.value);
  text += "\n" + plain(option.description);
  if (option.is_required && !option.is_positional) text += " (required)";
  return text + "\n";
}

// "gearsweep run study [options]"
std::string call_of(const CommandEntry& command) {
  std::string call = bold("gearsweep " + command.name);
  for (const OptionEntry& option : command.options) {
    if (!option.is_positional) continue;
    const std::string name = italic(option.names.front()) + (option.may_repeat ? " ..." : "");
    call += option.is_required ? " " + name : " [" + name + "]";
  }
  return call + " [" + italic("options") + "]";
}

std::string command_text(const CommandEntry& command) {
  std::string text = fmt::format(".SS {}\n{}\n.PP\n{}.\n", plain(command.name), call_of(command),
                                 plain(command.description));
  for (const OptionEntry& option : command.options) {
    if (option.names.back() != "--help") text += option_text(option);  // said once, above
  }
  return text + paragraphs(command.footer);
}

constexpr const char* kDescription =
    "gearsweep integrates a periodically forced system of differential equations, first of all a "
    "geared rotor-bearing pair with backlash, at every point of a parameter grid, on any OpenCL "
    "device: on CPUs through PoCL, on GPUs through the maker's driver.\n"
    "It writes maps: bifurcation diagrams, Lyapunov exponents, periods, contact and force maps, "
    "basins.\n\n"
    "What to compute is a study: a built-in one, a TOML file, or a result file, which holds its "
    "own "
    "study.\n"
    "Any key of a study may be overridden on the command line with --set PATH=VALUE, as in "
    "--set integrate.record=20 or --set axes.omega.count=40.";

struct Item {
  const char *name, *meaning;
};

constexpr Item kFiles[] = {
    {"STUDY.toml", "A study. 'gearsweep studies NAME' prints a built-in one to start from."},
    {"OUT.nc", "A result: NetCDF-4, one variable for each quantity, the study in its attributes."},
    {"OUT.nc.journal",
     "What an interrupted run has finished. The same command continues from there."},
    {"~/.cache/gearsweep/", "Built kernels of devices whose drivers keep none. Safe to delete."},
};

constexpr Item kEnvironment[] = {
    {"GEARSWEEP_CACHE_DIR",
     "Another folder for built kernels, for every driver; empty: they are not kept."},
    {"XDG_CACHE_HOME", "What stands for ~/.cache."},
    {"TMPDIR", "Where temporary files go while pictures are drawn. Default: /tmp."},
};

template <std::size_t kCount>
std::string items(const Item (&all)[kCount]) {
  std::string text;
  for (const Item& item : all) {
    text += fmt::format(".TP\n{}\n{}\n", italic(item.name), plain(item.meaning));
  }
  return text;
}

}  // namespace

std::string manual_page(const CommandTable& table) {
  const std::string& about = table.whole.description;  // "gearsweep: maps of ..."
  std::string text = fmt::format(
      ".TH GEARSWEEP 1 \"\" \"gearsweep {}\" \"User Commands\"\n.SH NAME\ngearsweep \\- {}\n"
      ".SH SYNOPSIS\n{} {} [{}]\n.br\n{} {} {}\n",
      version(), plain(about.substr(about.find(' ') + 1)), bold("gearsweep"), italic("command"),
      italic("options"), bold("gearsweep"), italic("command"), bold("--help"));
  text += section("DESCRIPTION", paragraphs(kDescription));
  text += ".SH OPTIONS\n";
  for (const OptionEntry& option : table.whole.options) text += option_text(option);
  text += ".SH COMMANDS\n";
  for (const CommandEntry& command : table.commands) text += command_text(command);
  text += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : exit_meanings()) {
    text += fmt::format(".TP\n{}\n{}\n", bold(fmt::format("{}", status)), plain(meaning));
  }
  text += ".SH ENVIRONMENT\n" + items(kEnvironment) + ".SH FILES\n" + items(kFiles);
  // What else help says at its end is said above.
  const std::string& footer = table.whole.footer;
  text += section("EXAMPLES", paragraphs(footer.substr(0, footer.find("\n\n"))));
  return text + ".SH SEE ALSO\n.BR clinfo (1),\n.BR gnuplot (1),\n.BR ncdump (1)\n";
}

}  // namespace gearsweep
