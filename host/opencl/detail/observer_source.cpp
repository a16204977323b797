#include "opencl/detail/observer_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>

#include "equations/field_graph.hpp"
#include "expression/differentiate.hpp"

namespace gearsweep {
namespace {

// What an observer is called in the program: motion, moments_of_x1.
std::string name_of(const Observer& observer) {
  const std::string& name = observer.observable->name;
  return observer.part.empty() ? name : fmt::format("{}_of_{}", name, observer.part);
}

bool is_verdict(const Observer& observer) {
  return observer.observable->role == ObservableRole::verdict;
}

// Whether it is told of each moment or step: an observer of a surface is told of impacts beside.
bool sees_all(const Observer& observer) {
  const ObservedPart part = observer.observable->part;
  return part == ObservedPart::whole || part == ObservedPart::surface;
}

bool is_of_surface(const Observer& observer) {
  return observer.observable->part == ObservedPart::surface;
}

bool has_many_sums(const Observer& observer) {
  return is_verdict(observer) || observer.observable->role == ObservableRole::statistic;
}

// Its accumulators; null where it has none.
std::string sums_of(const Observer& observer) {
  if (observer.accumulators == 0) return "0";
  return fmt::format("observers->{}", name_of(observer));
}

// A statement, broken after commas where it is longer than a line.
std::string wrapped(const std::string& statement) {
  constexpr std::size_t kColumns = 100;
  std::string text, line = "  ";
  std::istringstream words(statement);
  for (std::string word; words >> word;) {
    const bool is_first = line.find_first_not_of(' ') == std::string::npos;
    if (!is_first && line.size() + 1 + word.size() > kColumns) {
      text += line + "\n";
      line = fmt::format("      {}", word);
    } else {
      line += fmt::format("{}{}", is_first ? "" : " ", word);
    }
  }
  return text + line + "\n";
}

// Whether the level of a section depends on the side of a jump that the motion is on.
bool jumps_with_state(const Model& model, const SectionInfo& section) {
  const FieldGraph& field = *model.field;
  const std::vector<NodeId> parts = parts_of(field.graph, {field.signals[section.level]});
  return std::ranges::any_of(
      parts, [&](NodeId part) { return field.graph[part].symbol.starts_with("side["); });
}

class ObserverSource {
 public:
  explicit ObserverSource(const Study& study)
      : study_(study),
        observers_(study.selection.observers),
        sections_(study.selection.watched_sections()) {}

  std::string text() {
    write_settings();
    write_includes();
    write_struct();
    write_function("init", "const Observers* observers, const Instant* start",
                   [&](const Observer& observer) {
                     const bool is_section = observer.observable->part == ObservedPart::section;
                     return fmt::format(", {}", is_section ? "start" : seen(observer, "start"));
                   });
    write_function(
        "step", "const Observers* observers, const Step* step", [&](const Observer& observer) {
          if (sees_all(observer)) return std::string(", step");
          if (observer.observable->part == ObservedPart::section) {
            return fmt::format(", {}, step", seen(observer, "step"));
          }
          return fmt::format(", {}, {}, {}, {}, step", seen(observer, "step->earlier"),
                             seen(observer, "step->before"), seen(observer, "step->middle"),
                             seen(observer, "step->after"));
        });
    write_function("end_period", "const Observers* observers, const Section* section",
                   [](const Observer&) { return std::string(", section"); });
    if (!sections_.empty()) write_sections();
    if (std::ranges::any_of(observers_, is_of_surface)) write_meetings();
    write_finish();
    write_move("load", "__global const real* accumulators");
    write_move("store", "__global real* accumulators");
    return out_.str();
  }

 private:
  // What the observables want to know beside what they see. Only where it matters: a program that
  // differs in nothing else need not be built again.
  void write_settings() {
    for (const Observer& observer : observers_) {
      const bool recurs = is_verdict(observer) || observer.observable->name == "cycle";
      if (!recurs) continue;
      out_ << fmt::format("#define PERIOD_TOLERANCE {}\n", study_.selection.period_tolerance);
      break;
    }
    if (!sections_.empty()) {
      out_ << fmt::format("#define WATCHED_SECTION_COUNT {}\n#define WATCHED_SECTIONS(X)",
                          sections_.size());
      for (std::size_t i = 0; i < sections_.size(); ++i) {
        const Model& model = *study_.model;
        const SectionInfo& section =
            *std::ranges::find(model.sections, sections_[i], &SectionInfo::name);
        out_ << fmt::format(" \\\n  X({}, {}, {}, {}, {})", i,
                            model.name_in_kernel(model.signals[section.level].name),
                            model.name_in_kernel(model.signals[section.rate].name),
                            model.name_in_kernel(model.signals[section.size].name),
                            jumps_with_state(model, section) ? 1 : 0);
      }
      out_ << "\n";
    }
    if (study_.selection.poincare.empty()) return;
    if (!study_.selection.section.empty()) {
      out_ << fmt::format("#define SAMPLED_AT_SECTION {}\n", study_.selection.poincare.size());
    }
    out_ << "#define SAMPLED_STATES {";
    for (const std::size_t state : study_.selection.poincare) {
      const Model& model = *study_.model;
      out_ << fmt::format("STATE_{}, ", model.name_in_kernel(model.states[state].name));
    }
    out_ << "}\n";
  }

  void write_includes() {
    out_ << "#include \"observe.h\"\n";
    std::set<std::string> names;
    for (const Observer& observer : observers_) names.insert(observer.observable->name);
    for (const std::string& name : names) {
      out_ << fmt::format("#include \"observables/{}.h\"\n", name);
    }
  }

  // An array each: of one that is indexed in a loop the compiler makes memory, and a whole struct
  // of them would follow it out of the registers.
  void write_struct() {
    std::string members, arrays, pointers;
    for (const Observer& observer : observers_) {
      if (observer.accumulators == 0) continue;
      const std::string name = name_of(observer);
      members += fmt::format("  real* {};\n", name);
      arrays +=
          fmt::format("  real {}_sums[{}_accumulators]; \\\n", name, observer.observable->name);
      pointers += fmt::format("{}{}_sums", pointers.empty() ? "" : ", ", name);
    }
    if (members.empty()) {
      members += "  int none;  // a struct must have a member\n";
      pointers += "0";
    }
    out_ << "\n// What each observer keeps between rounds.\ntypedef struct {\n"
         << members << "} Observers;\n#define DECLARE_OBSERVERS(observers) \\\n"
         << arrays << "  const Observers observers = {" << pointers << "}\n";
  }

  // What an observer sees of a moment: all of it, the value of its channel, or its contact.
  std::string seen(const Observer& observer, const std::string& moment) const {
    const Model& model = *study_.model;
    if (sees_all(observer)) return moment;
    if (observer.observable->part == ObservedPart::channel) {
      const std::string name = model.name_in_kernel(observer.part);
      return model.find_state(observer.part) >= 0 ? fmt::format("{}->x[STATE_{}]", moment, name)
                                                  : fmt::format("{}->signals.{}", moment, name);
    }
    if (observer.observable->part == ObservedPart::section) {
      const auto place = std::ranges::find(sections_, observer.part) - sections_.begin();
      return fmt::format("&{}->crossings[{}]", moment, place);
    }
    const auto contact = std::ranges::find(model.contacts, observer.part, &ContactInfo::name);
    return fmt::format("contact_depths({0}->signals.{1}, {0}->signals.{2}, {3})", moment,
                       model.name_in_kernel(model.signals[contact->deflection].name),
                       model.name_in_kernel(model.signals[contact->backlash].name),
                       contact->is_one_sided);
  }

  // A function that calls that of each observable, with its accumulators and what `rest` gives.
  void write_function(const char* verb, const char* parameters,
                      const std::function<std::string(const Observer&)>& rest) {
    out_ << fmt::format("\nSHARED_FN void observers_{}({}) {{\n", verb, parameters);
    for (const Observer& observer : observers_) {
      out_ << wrapped(fmt::format("{}_{}({}{});", observer.observable->name, verb,
                                  sums_of(observer), rest(observer)));
    }
    out_ << "}\n";
  }

  // Each observer of a section keeps first where its level was when the last step ended.
  void write_sections() {
    out_ << "\nSHARED_FN void observers_sections(const Observers* observers,\n"
            "                                  SectionCrossing* crossings) {\n";
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const auto looks = [&](const Observer& observer) {
        return observer.observable->part == ObservedPart::section && observer.part == sections_[i];
      };
      const auto observer = std::ranges::find_if(observers_, looks);
      out_ << wrapped(fmt::format("crossings[{}].last = {}[0];", i, sums_of(*observer)));
    }
    out_ << "}\n";
  }

  void write_meetings() {
    out_ << "\n#define WATCHED_SURFACES\n"
            "SHARED_FN void observers_meet(const Observers* observers, mask where,\n"
            "                              const SurfaceMet* met, Share once) {\n";
    const std::vector<SurfaceInfo>& surfaces = study_.model->surfaces;
    for (const Observer& observer : observers_) {
      if (!is_of_surface(observer)) continue;
      const auto place =
          std::ranges::find(surfaces, observer.part, &SurfaceInfo::name) - surfaces.begin();
      out_ << wrapped(fmt::format("{0}_meet({1}, where & met->hit[{2}], met->rate[{2}], once);",
                                  observer.observable->name, sums_of(observer), place));
    }
    out_ << "}\n";
  }

  // Outputs stand in the order of the observers.
  void write_finish() {
    out_ << "\nSHARED_FN void observers_finish(const Observers* observers, SweepRound round,\n"
            "                                __global real* outputs, uint items, uint item) {\n";
    std::size_t first = 0;
    for (const Observer& observer : observers_) {
      if (observer.outputs == 0) continue;
      const std::string& name = observer.observable->name;
      const std::string out = name_of(observer);
      out_ << wrapped(fmt::format("real {}[{}_outputs];", out, name))
           << wrapped(fmt::format("{}_finish({}, round, {});", name, sums_of(observer), out))
           << wrapped(fmt::format("store_components(outputs, items, item, {}, {}_outputs, {});",
                                  first, name, out));
      first += observer.outputs;
    }
    out_ << "}\n";
  }

  // Accumulators stand in the order of the observers, [accumulator][item]. Verdicts and
  // statistics have many, and the loop over them is not unrolled.
  void write_move(const std::string& verb, const char* buffer) {
    out_ << fmt::format(
        "\nSHARED_FN void observers_{}(const Observers* observers, {},\n"
        "                              uint items, uint item) {{\n",
        verb, buffer);
    std::size_t first = 0;
    for (const Observer& observer : observers_) {
      if (observer.accumulators == 0) continue;
      out_ << wrapped(fmt::format("{}_{}(accumulators, items, item, {}, {}_accumulators, {});",
                                  verb, has_many_sums(observer) ? "many" : "components", first,
                                  observer.observable->name, sums_of(observer)));
      first += observer.accumulators;
    }
    out_ << "}\n";
  }

  const Study& study_;
  const std::vector<Observer>& observers_;
  const std::vector<std::string> sections_;  // that are watched
  std::ostringstream out_;
};

}  // namespace

std::string observers_header(const Study& study) { return ObserverSource(study).text(); }

}  // namespace gearsweep
