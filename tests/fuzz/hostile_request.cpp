// What strangers may ask the explorer for.
#include <httplib.h>

#include <nlohmann/json.hpp>

#include "explore/detail/request_values.hpp"
#include "explore/scene.hpp"
#include "explore/view_study.hpp"
#include "fuzz/targets.hpp"
#include "model/error.hpp"

namespace gearsweep::testing {
namespace {

const ExploredStudy& explored_study() {
  static const ExploredStudy study = {
      explorable(read_study("[model]\nname = 'duffing'\n[[axes]]\nname = 'omega'\nfrom = 0.8\n"
                            "to = 1.6\ncount = 3\n[observe]\nquantities = ['x_max']\n",
                            "the base")),
      std::nullopt};
  return study;
}

// As the server does with what is wrong: it refuses it.
template <typename Read>
void answer(const Read& read) {
  try {
    read();
  } catch (const Refusal&) {
    return;
  } catch (const InputError&) {
    return;
  } catch (const nlohmann::json::exception&) {
    return;
  }
}

}  // namespace

void read_hostile_request(const std::string& bytes) {
  httplib::Request request;
  const std::size_t line = std::min(bytes.find('\n'), bytes.size());
  httplib::detail::parse_query_text(bytes.substr(0, line), request.params);
  const std::string text = line < bytes.size() ? bytes.substr(line + 1) : "";

  const Scene own(explored_study(), {});
  answer([&] { Scene(explored_study(), changes_of(request)); });
  answer([&] {
    const Cell cell = cell_of(request);
    own.value_at(0, cell.k[0], cell.depth);
  });
  answer([&] {
    view_study(own, {shares_of(request),
                     {number_of<std::size_t>(request, "nx", 2),
                      number_of<std::size_t>(request, "ny", 2)}});
  });
  const auto body = [&] { return nlohmann::json::parse(text); };
  answer([&] { read_places(body().at("tiles")); });
  answer([&] { read_line(body()); });
  answer([&] { read_strips(body().at("strips")); });
  answer([&] { cells_in(read_view(body().at("view")), 300); });
}

}  // namespace gearsweep::testing
