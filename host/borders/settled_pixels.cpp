#include "borders/settled_pixels.hpp"

#include "borders/query_points.hpp"
#include "model/on_all_cores.hpp"
#include "orbits/floquet.hpp"
#include "plan/plan.hpp"
#include "plan/study_points.hpp"
#include "sweep_types.h"
#include "tile/tile_run.hpp"

namespace gearsweep {
namespace {

constexpr double kNearby = 0.3;  // of the sizes: from where a motion settled to its orbit
constexpr std::size_t kStepsForSizes = 64;

// The sizes of the states along a motion; nothing where it leaves its range. What the host knows of
// a reduced model takes the states of the whole one; those that drive nothing may be anywhere.
std::optional<Eigen::VectorXd> sizes_along(const ParameterPlane& plane, const HeldOrbit& guess) {
  const Model& model = *plane.model;
  if (model.whole == nullptr) {
    const PeriodMap map(model, plane.setting_at(guess.place), kStepsForSizes);
    const std::optional<PeriodImage> image = map.linearize(guess.state, guess.period);
    return image ? std::optional(sizes_of(*image)) : std::nullopt;
  }
  Eigen::VectorXd state =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.whole->states.size()));
  std::vector<Eigen::Index> kept(model.reduction.kept.begin(), model.reduction.kept.end());
  state(kept) = guess.state;
  for (const MirrorPairs::Pair& pair : model.reduction.mirrors) {
    state[static_cast<Eigen::Index>(pair.second)] = -state[static_cast<Eigen::Index>(pair.first)];
  }
  const PeriodMap map(*model.whole, plane.setting_at(guess.place), kStepsForSizes);
  const std::optional<PeriodImage> image = map.linearize(state, guess.period);
  if (!image) return std::nullopt;
  return Eigen::VectorXd(sizes_of(*image)(kept));
}

}  // namespace

SettledPixels::SettledPixels(std::shared_ptr<const Study> study, const ParameterPlane& plane,
                             const PeriodPixels& pixels, Engine* engine, OrbitMap* held,
                             const std::atomic<bool>* stop)
    : study_(std::move(study)),
      plane_(plane),
      pixels_(pixels),
      engine_(engine),
      held_(held),
      stop_(stop) {}

const HeldOrbit* SettledPixels::orbit(std::size_t pixel) const {
  const auto found = known_.find(pixel);
  return found != known_.end() && found->second ? &*found->second : nullptr;
}

void SettledPixels::take_sizes(std::vector<HeldOrbit>* guesses,
                               std::vector<std::size_t>* owners) const {
  std::vector<std::optional<Eigen::VectorXd>> sizes(guesses->size());
  for_each_on_all_cores(sizes.size(),
                        [&](std::size_t i) { sizes[i] = sizes_along(plane_, (*guesses)[i]); });
  std::vector<HeldOrbit> known;
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!sizes[i]) continue;
    (*guesses)[i].sizes = *sizes[i];
    known.push_back(std::move((*guesses)[i]));
    own.push_back((*owners)[i]);
  }
  *guesses = std::move(known);
  *owners = std::move(own);
}

void SettledPixels::settle(const std::vector<std::size_t>& pixels) {
  std::vector<std::size_t> asked;
  std::vector<OrbitQuery> starts;
  for (const std::size_t pixel : pixels) {
    if (pixels_.label(pixel) == 0 || !known_.emplace(pixel, std::nullopt).second) continue;
    const PlanePlace place = pixels_.place(pixel);
    const std::vector<double> start = start_of_policy(*study_, plane_.setting_at(place));
    asked.push_back(pixel);
    starts.push_back({{place.begin(), place.end()},
                      Eigen::VectorXd::Map(start.data(), static_cast<Eigen::Index>(start.size())),
                      1});
  }
  if (asked.empty()) return;
  const auto points = std::make_shared<const QueryPoints>(
      *study_->model, std::vector<std::size_t>(plane_.parameters.begin(), plane_.parameters.end()),
      starts);
  const Plan plan(study_, points, engine_->preferred_tile());
  const RoundCallback may_go_on = [this](double) { return stop_ == nullptr || !*stop_; };
  std::vector<HeldOrbit> guesses;
  std::vector<std::size_t> owners;
  const std::size_t states = study_->model->states.size();
  for (const Tile& tile : plan.stages().front().tiles) {
    std::vector<double> initial;
    for (const std::size_t point : tile.points) append(plan.own_initial_state(point), &initial);
    const std::optional<TileResult> result =
        run_tile(plan, tile, initial, engine_, {may_go_on, [](double) {}});
    if (!result) throw SearchStopped();
    for (std::size_t i = 0; i < tile.points.size(); ++i) {
      if (result->status[i] != STATUS_ok) continue;
      const std::size_t pixel = asked[tile.points[i]];
      HeldOrbit guess;
      guess.place = pixels_.place(pixel);
      guess.period = static_cast<std::size_t>(pixels_.label(pixel));
      guess.state = Eigen::VectorXd::Map(result->final_states.data() + i * states,
                                         static_cast<Eigen::Index>(states));
      guesses.push_back(std::move(guess));
      owners.push_back(pixel);
    }
  }
  take_sizes(&guesses, &owners);
  const auto found = hold_orbits(plane_, held_, guesses, kNearby);
  std::vector<HeldOrbit> stable;
  std::vector<std::size_t> pixels_of_stable;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i] || !found[i]->is_stable()) continue;
    stable.push_back(*found[i]);
    pixels_of_stable.push_back(owners[i]);
  }
  // Those that come back sooner are not the motions that the map shows.
  const std::vector<bool> is_shorter = return_sooner(plane_, held_, stable);
  for (std::size_t i = 0; i < stable.size(); ++i) {
    if (!is_shorter[i]) known_[pixels_of_stable[i]] = stable[i];
  }
}

}  // namespace gearsweep
