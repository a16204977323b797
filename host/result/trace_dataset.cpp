#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "result/dataset.hpp"
#include "result/detail/file_names.hpp"
#include "result/detail/file_notes.hpp"

namespace gearsweep {
namespace {

constexpr const char* kTraces = "trace";
constexpr const char* kMoments = "moment";

// Puts the dataset together, variable by variable.
class TraceDescription {
 public:
  TraceDescription(const std::vector<Trace>& traces, const Study& study,
                   const std::vector<std::string>& placed)
      : traces_(traces), study_(study), placed_(placed), notes_(study, placed) {
    for (const Trace& trace : traces) longest_ = std::max(longest_, trace.tau.size());
  }

  Dataset make(const std::vector<std::string>& labels, const Provenance& provenance) {
    out_.attributes = {{"content", kContentOfTraces}};
    for (Attribute& own : notes_.provenance(provenance)) out_.attributes.push_back(std::move(own));
    out_.dimensions = {{kTraces, traces_.size()}, {kMoments, longest_}};
    add_labels(labels);
    const std::string time = time_unit(*study_.model);
    const bool is_clockless = traces_.front().is_clockless;
    add_numbers("period", time,
                is_clockless ? "period that time is counted in: there is no forcing"
                             : "forcing period in dimensionless time",
                [](const Trace& trace) { return trace.period; });
    if (is_clockless) {
      add_numbers(kClockless, "1", "1: a model without forcing", [](const Trace&) { return 1.0; });
    }
    if (std::ranges::any_of(traces_,
                            [](const Trace& trace) { return trace.mesh_periods != 1.0; })) {
      add_numbers(kMeshPeriods, "1", "mesh periods in one forcing period",
                  [](const Trace& trace) { return trace.mesh_periods; });
    }
    add_numbers("settled", "1", "periods before the first moment",
                [](const Trace& trace) { return static_cast<double>(trace.settled); });
    for (const std::string& name : placed_) add_parameter(name);
    add_history({"tau", time, "dimensionless time since the first moment"},
                [](const Trace& trace) -> const std::vector<double>& { return trace.tau; });
    const std::vector<ChannelInfo>& channels = traces_.front().channels;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      add_history(channels[i], [i](const Trace& trace) -> const std::vector<double>& {
        return trace.values[i];
      });
    }
    return std::move(out_);
  }

 private:
  void add_labels(const std::vector<std::string>& labels) {
    std::size_t width = 1;
    for (const std::string& label : labels) width = std::max(width, label.size());
    std::string all;
    for (std::string label : labels) {
      label.resize(width, ' ');
      all += label;
    }
    out_.dimensions.push_back({"label_width", width});
    out_.variables.push_back(
        {.name = "label",
         .stored = Stored::letter,
         .dimensions = {kTraces, "label_width"},
         .attributes = {{"long_name", "what each trace is of"}, {"_Encoding", "utf-8"}},
         .elements = all});
  }

  void add_parameter(const std::string& name) {
    const auto parameter = static_cast<std::size_t>(study_.model->find_parameter(name));
    const ParameterInfo& info = study_.model->parameters[parameter];
    add_numbers(name_in_traces(name, traces_.front().channels), info.unit, info.meaning,
                [&](const Trace& trace) { return trace.setting.parameters[parameter]; });
  }

  template <class Value>
  void add_numbers(const std::string& name, const std::string& unit, const std::string& meaning,
                   const Value& value) {
    std::vector<double> numbers;
    for (const Trace& trace : traces_) numbers.push_back(value(trace));
    out_.variables.push_back({.name = name,
                              .stored = Stored::real,
                              .dimensions = {kTraces},
                              .attributes = notes_.describe(unit, meaning),
                              .elements = std::move(numbers)});
  }

  // Missing values stand beyond a trace's end.
  template <class Values>
  void add_history(const ChannelInfo& info, const Values& values_of) {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    DataVariable variable = {.name = info.name,
                             .stored = Stored::real,
                             .dimensions = {kTraces, kMoments},
                             .attributes = notes_.describe(info.unit, info.meaning),
                             .is_compressed = true};
    if (info.role != Role::none) variable.attributes.push_back({kRole, name_of(info.role)});
    if (!info.velocity.empty()) variable.attributes.push_back({kVelocity, info.velocity});
    variable.attributes.push_back({"_FillValue", kMissing});
    if (traces_.size() == 1) {
      variable.elements = std::span<const double>(values_of(traces_.front()));
    } else {
      std::vector<double> all;
      all.reserve(traces_.size() * longest_);
      for (const Trace& trace : traces_) {
        const std::vector<double>& own = values_of(trace);
        all.insert(all.end(), own.begin(), own.end());
        all.resize(all.size() + longest_ - own.size(), kMissing);
      }
      variable.elements = std::move(all);
    }
    out_.variables.push_back(std::move(variable));
  }

  const std::vector<Trace>& traces_;
  const Study& study_;
  const std::vector<std::string>& placed_;
  const FileNotes notes_;
  std::size_t longest_ = 0;  // moments
  Dataset out_;
};

}  // namespace

Dataset dataset_of(const std::vector<Trace>& traces, const std::vector<std::string>& labels,
                   const std::vector<std::string>& placed, const Study& study,
                   const Provenance& provenance) {
  return TraceDescription(traces, study, placed).make(labels, provenance);
}

}  // namespace gearsweep
