#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cli/detail/bench_report.hpp"
#include "measure/samples.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

// Seconds of an iteration, and its rate, of each repetition.
struct Times {
  std::vector<double> real, cpu, rates;
};

Times times_of(const BenchmarkRow& row) {
  Times times{{}, {}, row.rates()};
  for (const Repetition& one : row.repetitions) {
    const double per_iteration = row.item.per_iteration / one.items;
    times.real.push_back(per_iteration * one.seconds);
    times.cpu.push_back(per_iteration * one.core_seconds);
  }
  return times;
}

// What all entries of a benchmark have.
nlohmann::json entry_of(const BenchmarkRow& row, const std::string& name, std::size_t family) {
  nlohmann::json entry = {{"name", name},
                          {"run_name", name},
                          {"family_index", family},
                          {"per_family_instance_index", 0},
                          {"repetitions", row.repetitions.size()},
                          {"threads", 1},
                          {"time_unit", "us"}};
  entry["label"] = row.item.per_iteration > 1
                       ? fmt::format("{:.0f} {}s", row.item.per_iteration, row.item.name)
                       : "1 " + row.item.name;
  if (!row.build_options.empty()) entry["build_options"] = row.build_options;
  return entry;
}

void set_times(double real, double cpu, double rate, nlohmann::json* entry) {
  (*entry)["real_time"] = real;
  (*entry)["cpu_time"] = cpu;
  (*entry)["items_per_second"] = rate;
}

void add_repetitions(const BenchmarkRow& row, const nlohmann::json& common, nlohmann::json* list) {
  const Times times = times_of(row);
  for (std::size_t i = 0; i < row.repetitions.size(); ++i) {
    nlohmann::json entry = common;
    entry["run_type"] = "iteration";
    entry["repetition_index"] = i;
    entry["iterations"] =
        std::llround(std::max(1.0, std::round(row.repetitions[i].items / row.item.per_iteration)));
    set_times(1e6 * times.real[i], 1e6 * times.cpu[i], times.rates[i], &entry);
    for (const auto& [name, value] : row.repetitions[i].figures) entry[name] = value;
    list->push_back(entry);
  }
}

// Mean, median, standard deviation, and the latter over the mean, as the library adds them.
void add_aggregates(const BenchmarkRow& row, const nlohmann::json& common, nlohmann::json* list) {
  using Aggregate = std::function<double(const std::vector<double>&)>;
  const auto add = [&](const std::string& name, const std::string& unit, double factor,
                       const Aggregate& of) {
    nlohmann::json entry = common;
    entry["name"] = fmt::format("{}_{}", common.at("name").get<std::string>(), name);
    entry["run_type"] = "aggregate";
    entry["aggregate_name"] = name;
    entry["aggregate_unit"] = unit;
    entry["iterations"] = row.repetitions.size();
    const Times times = times_of(row);
    set_times(factor * of(times.real), factor * of(times.cpu), of(times.rates), &entry);
    for (const auto& [figure, value] : row.repetitions.front().figures) {
      entry[figure] = of(row.figures(figure));
    }
    list->push_back(entry);
  };
  const auto relative = [](const std::vector<double>& values) {
    const double middle = mean(values);
    return middle > 0.0 ? standard_deviation(values) / middle : 0.0;
  };
  add("mean", "time", 1e6, mean);
  add("median", "time", 1e6, median);
  add("stddev", "time", 1e6, standard_deviation);
  add("cv", "percentage", 1.0, relative);
}

void add_row(const BenchmarkRow& row, const std::string& name, std::size_t family,
             nlohmann::json* list) {
  nlohmann::json common = entry_of(row, name, family);
  if (row.repetitions.empty()) {
    common["run_type"] = "iteration";
    common["error_occurred"] = true;
    common["error_message"] = row.reason;
    common["iterations"] = 0;
    set_times(0.0, 0.0, 0.0, &common);
    list->push_back(common);
    return;
  }
  add_repetitions(row, common, list);
  if (row.repetitions.size() > 1) add_aggregates(row, common, list);
}

nlohmann::json context_of(const Machine& machine, const std::vector<BenchedDevice>& devices,
                          const std::string& date) {
#ifdef NDEBUG
  const char* const build = "release";
#else
  const char* const build = "debug";
#endif
  nlohmann::json list = nlohmann::json::array();
  for (const BenchedDevice& device : devices) {
    list.push_back({{"number", device.number},
                    {"name", device.info.name},
                    {"platform", device.info.platform},
                    {"driver", device.info.driver},
                    {"type", device.info.is_cpu ? "cpu" : "gpu"},
                    {"compute_units", device.info.compute_units},
                    {"fp64", device.info.fp64}});
  }
  return {{"date", date},
          {"host_name", machine.host_name},
          {"executable", "gearsweep bench"},
          {"num_cpus", machine.cores},
          {"mhz_per_cpu", std::lround(machine.mhz_per_core)},
          {"cpu_scaling_enabled", machine.scales_clock},
          {"caches", nlohmann::json::array()},
          {"load_avg", {machine.load}},
          {"library_build_type", build},
          {"gearsweep_version", version()},
          {"source_hash", source_hash()},
          {"devices", list}};
}

}  // namespace

nlohmann::json bench_json(const Machine& machine, const std::vector<BenchedDevice>& devices,
                          const std::string& date) {
  nlohmann::json list = nlohmann::json::array();
  std::size_t family = 0;
  for (const BenchedDevice& device : devices) {
    for (const BenchmarkRow& row : device.rows) {
      const std::string name =
          devices.size() > 1 ? fmt::format("device:{}/{}", device.number, row.name) : row.name;
      add_row(row, name, family++, &list);
    }
  }
  return {{"context", context_of(machine, devices, date)}, {"benchmarks", list}};
}

}  // namespace gearsweep
