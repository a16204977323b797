#include <pybind11/stl.h>

#include <optional>

#include "core/background.hpp"
#include "core/parts.hpp"
#include "core/result.hpp"
#include "core/session.hpp"
#include "journal/notes.hpp"
#include "model/version.hpp"
#include "sweep/shard_merge.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::python {

namespace py = pybind11;

namespace {

// Computes a shard, "2/8", into a journal; what it warns of.
std::vector<std::string> run_shard_of(Session* session, const Study& study,
                                      const std::string& device, const std::string& journal,
                                      const std::string& shard, const std::string& call) {
  SweepOptions options = session->options_for(device);
  options.shard = parse_shard(shard);
  options.journal_path = journal;
  options.keep_journal = true;
  options.notes = {{notes::kCommand, call}};
  Mailbox<std::string> warnings;
  options.warn = [&](const std::string& warning) { warnings.put(warning); };
  run_in_background([&](const std::atomic<bool>& stop) {
    options.stop = &stop;
    run_shard(study, options);
  });
  return warnings.take();
}

py::tuple merged(const std::vector<std::string>& journals, const std::string& call) {
  std::optional<SweepResult> result;
  run_in_background([&](const std::atomic<bool>&) { result = merge_shards(journals); });
  return as_tuple(dataset_of(*result, {call, version(), source_hash()}));
}

}  // namespace

void add_shards(py::module_* module, SessionClass* session) {
  session->def("run_shard", run_shard_of, py::call_guard<Computation>(), py::arg("study"),
               py::arg("device"), py::arg("journal"), py::arg("shard"), py::arg("call"));
  // 0 where the study says itself how it is cut.
  module->def("tile_for_shards", [](const Study& study, std::size_t count) {
    return study.integrate.tile > 0 ? 0 : tile_for_shards(study.trajectories(), count);
  });
  module->def("merge_shards", merged, py::call_guard<Computation>(), py::arg("journals"),
              py::arg("call"));
}

}  // namespace gearsweep::python
