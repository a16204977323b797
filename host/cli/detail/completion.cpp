#include "cli/detail/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/detail/arguments.hpp"
#include "cli/detail/study_source.hpp"
#include "model/model.hpp"
#include "model/names.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep {
namespace {

// What may stand for a value.
struct Candidates {
  std::vector<std::string> words;
  std::vector<std::string> endings;  // of files: "nc"
  bool any_file = false, folders = false;
};

Candidates candidates_of(const std::string& value) {
  if (value == kStudyValue) return {builtin_study_names(), {"toml", "nc"}, false, false};
  if (value == kBuiltinValue) return {builtin_study_names(), {}, false, false};
  if (value == kModelValue) return {model_names(), {}, false, false};
  if (value == kResultValue) return {{}, {"nc"}, false, false};
  if (value == kFileValue) return {{}, {}, true, false};
  if (value == kFolderValue) return {{}, {}, false, true};
  if (value.find('|') != std::string::npos) return {split(value, '|'), {}, false, false};
  return {};
}

std::string bash_reply(const Candidates& candidates) {
  std::string text;
  if (!candidates.words.empty()) {
    text += fmt::format(" _gearsweep_words '{}';", fmt::join(candidates.words, " "));
  }
  if (!candidates.endings.empty()) {
    text += fmt::format(" _gearsweep_files '{}';", fmt::join(candidates.endings, " "));
  }
  if (candidates.any_file) text += " _gearsweep_files '';";
  if (candidates.folders) text += " _gearsweep_folders;";
  return text.empty() ? " :;" : text;
}

// Options of the command, what follows each of them, what else it takes.
std::string bash_case(const CommandEntry& command) {
  std::vector<std::string> options;
  std::string values, positional = " :;";
  for (const OptionEntry& option : command.options) {
    if (option.is_positional) {
      positional = bash_reply(candidates_of(option.value));
      continue;
    }
    options.insert(options.end(), option.names.begin(), option.names.end());
    if (option.value.empty()) continue;
    values += fmt::format("        {}){} return ;;\n", fmt::join(option.names, "|"),
                          bash_reply(candidates_of(option.value)));
  }
  std::string text = fmt::format("    {})\n", command.name);
  if (!values.empty()) text += "      case $before in\n" + values + "      esac\n";
  return text + fmt::format(
                    "      case $word in\n        -*) _gearsweep_words '{}' ;;\n"
                    "        *){}; ;;\n      esac ;;\n",
                    fmt::join(options, " "), positional.substr(0, positional.size() - 1));
}

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') out += '\\';
    out += letter;
  }
  return out + "'";
}

std::string fish_arguments(const Candidates& candidates) {
  std::string arguments = fmt::format("{}", fmt::join(candidates.words, " "));
  for (const std::string& ending : candidates.endings) {
    arguments += fmt::format(" (__fish_complete_suffix .{})", ending);
  }
  if (candidates.any_file) arguments += " (__fish_complete_path)";
  if (candidates.folders) arguments += " (__fish_complete_directories)";
  return arguments;
}

std::string fish_option(const std::string& condition, const OptionEntry& option) {
  const std::string start = fmt::format("complete -c gearsweep -n {}", fish_quoted(condition));
  const std::string arguments = fish_arguments(candidates_of(option.value));
  if (option.is_positional) {
    return arguments.empty() ? "" : fmt::format("{} -a {}\n", start, fish_quoted(arguments));
  }
  std::string line = start;
  for (const std::string& name : option.names) {
    line += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.value.empty()) line += " -x";
  if (!arguments.empty()) line += " -a " + fish_quoted(arguments);
  return line + " -d " + fish_quoted(option.description) + "\n";
}

constexpr const char* kBashHead =
    R"(# Completion of gearsweep for bash, and for zsh through bashcompinit.
_gearsweep_words() {
  local candidate
  for candidate in $1; do
    [[ $candidate == "$word"* ]] && COMPREPLY+=("$candidate")
  done
}

_gearsweep_folders() {
  local path
  while IFS= read -r path; do
    COMPREPLY+=("$path")
  done < <(compgen -d -- "$word")
  compopt -o filenames 2>/dev/null
}

# Files with one of these endings, any file without them; folders lead on to more.
_gearsweep_files() {
  local path ending
  _gearsweep_folders
  while IFS= read -r path; do
    [[ -d $path ]] && continue
    [[ -z $1 ]] && COMPREPLY+=("$path")
    for ending in $1; do
      [[ $path == *."$ending" ]] && COMPREPLY+=("$path")
    done
  done < <(compgen -f -- "$word")
}

_gearsweep() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
)";

constexpr const char* kBashTail = R"(  esac
}

complete -F _gearsweep gearsweep
)";

}  // namespace

std::string bash_completion(const CommandTable& table) {
  std::vector<std::string> first;
  for (const CommandEntry& command : table.commands) first.push_back(command.name);
  for (const OptionEntry& option : table.whole.options) {
    first.insert(first.end(), option.names.begin(), option.names.end());
  }
  std::string text = kBashHead;
  text += fmt::format("    _gearsweep_words '{}'\n    return\n  fi\n  case ${{COMP_WORDS[1]}} in\n",
                      fmt::join(first, " "));
  for (const CommandEntry& command : table.commands) text += bash_case(command);
  return text + kBashTail;
}

std::string fish_completion(const CommandTable& table) {
  std::string text = "# Completion of gearsweep for fish.\ncomplete -c gearsweep -f\n";
  for (const OptionEntry& option : table.whole.options) {
    text += fish_option("__fish_use_subcommand", option);
  }
  for (const CommandEntry& command : table.commands) {
    text += fmt::format("complete -c gearsweep -n __fish_use_subcommand -a {} -d {}\n",
                        command.name, fish_quoted(command.description));
    const std::string condition = "__fish_seen_subcommand_from " + command.name;
    for (const OptionEntry& option : command.options) text += fish_option(condition, option);
  }
  return text;
}

}  // namespace gearsweep
