#include "cli/detail/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/detail/roff.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

std::string option_text(const OptionEntry& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back(option.is_positional ? roff_italic(name) : roff_bold(name));
  }
  std::string text = fmt::format(".TP\n{}", fmt::join(names, ", "));
  if (!option.value.empty() && !option.is_positional) text += " " + roff_italic(option.value);
  text += "\n" + roff_plain(option.description);
  if (option.is_required && !option.is_positional) text += " (required)";
  return text + "\n";
}

// "gearsweep run study [options]"
std::string call_of(const CommandEntry& command) {
  std::string call = roff_bold("gearsweep " + command.name);
  for (const OptionEntry& option : command.options) {
    if (!option.is_positional) continue;
    const std::string name = roff_italic(option.names.front()) + (option.may_repeat ? " ..." : "");
    call += option.is_required ? " " + name : " [" + name + "]";
  }
  return call + " [" + roff_italic("options") + "]";
}

std::string command_text(const CommandEntry& command) {
  std::string text = fmt::format(".SS {}\n{}\n.PP\n{}.\n", roff_plain(command.name),
                                 call_of(command), roff_plain(command.description));
  for (const OptionEntry& option : command.options) {
    if (option.names.back() != "--help") text += option_text(option);  // said once, above
  }
  return text + roff_paragraphs(command.footer);
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
    {"STUDY.toml",
     "A study: gearsweep-study(5) has its keys, 'gearsweep studies NAME' prints one to start "
     "from."},
    {"OUT.nc", "A result: NetCDF-4, one variable for each quantity, the study in its attributes."},
    {"OUT.nc.journal",
     "What an interrupted run, or search for curves, has finished. The same command continues from "
     "there."},
    {"~/.cache/gearsweep/", "Built kernels of devices whose drivers keep none. Safe to delete."},
};

constexpr Item kEnvironment[] = {
    {"GEARSWEEP_CACHE_DIR",
     "Another folder for built kernels, for every driver; empty: they are not kept."},
    {"GEARSWEEP_LANES",
     "How many points a work-item of a CPU integrates at once: 1, 2, 4, 8 or 16. Default: what the "
     "driver says of the processor's vectors."},
    {"XDG_CACHE_HOME", "What stands for ~/.cache."},
    {"TMPDIR", "Where temporary files go while pictures are drawn. Default: /tmp."},
};

template <std::size_t kCount>
std::string items(const Item (&all)[kCount]) {
  std::string text;
  for (const Item& item : all) {
    text += roff_item(roff_italic(item.name), roff_plain(item.meaning));
  }
  return text;
}

}  // namespace

std::string manual_page(const CommandTable& table) {
  const std::string& about = table.whole.description;  // "gearsweep: maps of ..."
  std::string text = fmt::format(
      ".TH GEARSWEEP 1 \"\" \"gearsweep {}\" \"User Commands\"\n.SH NAME\ngearsweep \\- {}\n"
      ".SH SYNOPSIS\n{} {} [{}]\n.br\n{} {} {}\n",
      version(), roff_plain(about.substr(about.find(' ') + 1)), roff_bold("gearsweep"),
      roff_italic("command"), roff_italic("options"), roff_bold("gearsweep"),
      roff_italic("command"), roff_bold("--help"));
  text += roff_section("DESCRIPTION", roff_paragraphs(kDescription));
  text += ".SH OPTIONS\n";
  for (const OptionEntry& option : table.whole.options) text += option_text(option);
  text += ".SH COMMANDS\n";
  for (const CommandEntry& command : table.commands) text += command_text(command);
  text += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : exit_meanings()) {
    text += roff_item(roff_bold(fmt::format("{}", status)), roff_plain(meaning));
  }
  text += ".SH ENVIRONMENT\n" + items(kEnvironment) + ".SH FILES\n" + items(kFiles);
  // What else help says at its end is said above.
  const std::string& footer = table.whole.footer;
  text += roff_section("EXAMPLES", roff_paragraphs(footer.substr(0, footer.find("\n\n"))));
  return text +
         ".SH SEE ALSO\n.BR gearsweep\\-study (5),\n.BR clinfo (1),\n.BR gnuplot (1),\n.BR ncdump "
         "(1)\n";
}

}  // namespace gearsweep
