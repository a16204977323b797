#include "plan/detail/structure.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "model/array.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kSamples = 12;  // of each setting

// A state and a phase, the same on all machines.
struct Sample {
  std::vector<double> x, coefs;
};

std::vector<Sample> samples_of(const Model& model, const ModelSetting& setting) {
  std::mt19937_64 random(1);
  const auto unit = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  const std::vector<double> rest = model.equilibrium(setting);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < kSamples; ++i) {
    // From a tenth of the distances that the model itself has to a hundred times them.
    const double size = std::pow(10.0, static_cast<double>(i % 4) - 1.0);
    Sample sample{rest, std::vector<double>(model.phase_coefs.size())};
    for (double& x : sample.x) x += (1.0 + std::abs(x)) * size * (2.0 * unit() - 1.0);
    const double phase = unit();
    model.phase_coefs_at(setting, phase, phase, sample.coefs.data());
    samples.push_back(std::move(sample));
  }
  return samples;
}

// J of the left-out block, see left_out_block(); jacobian: [row][column] of the whole model.
std::vector<double> block_of(const Reduction& reduction, const std::vector<double>& jacobian,
                             std::size_t states) {
  const Array2 rows(jacobian, states);
  const std::size_t passive = reduction.passive.size();
  const std::size_t size = passive + reduction.mirrors.size();
  std::vector<double> block(size * size);
  const Array2 columns(block, size);
  for (std::size_t j = 0; j < passive; ++j) {
    for (std::size_t i = 0; i < passive; ++i) {
      columns[j][i] = rows[reduction.passive[i]][reduction.passive[j]];
    }
  }
  // A passive state may be driven by the sums, but that changes no eigenvalue.
  for (std::size_t j = 0; j < reduction.mirrors.size(); ++j) {
    const auto [from, from_mirrored] = reduction.mirrors[j];
    for (std::size_t i = 0; i < reduction.mirrors.size(); ++i) {
      const auto [to, to_mirrored] = reduction.mirrors[i];
      columns[passive + j][passive + i] =
          0.5 * ((rows[to][from] + rows[to_mirrored][from]) +
                 (rows[to][from_mirrored] + rows[to_mirrored][from_mirrored]));
    }
  }
  return block;
}

// Within rounding of the jacobian's entries.
bool are_alike(const std::vector<double>& a, const std::vector<double>& b, double scale) {
  constexpr double kRounding = 1e-12;
  return std::ranges::equal(
      a, b, [&](double one, double other) { return std::abs(one - other) <= kRounding * scale; });
}

double max_size(const std::vector<double>& values) {
  double max = 0.0;
  for (const double value : values) max = std::max(max, std::abs(value));
  return max;
}

}  // namespace

Structure::Structure(const Model& model, const std::vector<ModelSetting>& settings)
    : model_(model),
      settings_(settings),
      drivers_(model.states.size()),
      signal_drivers_(model.signals.size()) {
  for (const ModelSetting& setting : settings) {
    const std::unique_ptr<PreparedPoint> point = model.prepare(setting);
    for (const Sample& sample : samples_of(model, setting)) {
      look(*point, sample.coefs, sample.x);
      look_at_contact(*point, sample.coefs, sample.x);
    }
  }
}

// A state drives whatever changes with it.
void Structure::look(const PreparedPoint& point, const std::vector<double>& coefs,
                     const std::vector<double>& x) {
  const std::size_t states = x.size();
  std::vector<double> dx(states), moved_dx(states);
  std::vector<double> signals(signal_drivers_.size()), moved_signals(signals.size());
  point.rhs(coefs.data(), x.data(), dx.data());
  point.signals(coefs.data(), x.data(), signals.data());
  for (std::size_t j = 0; j < states; ++j) {
    constexpr double kMove = 0.37;
    std::vector<double> moved = x;
    moved[j] += kMove * (1.0 + std::abs(x[j]));
    point.rhs(coefs.data(), moved.data(), moved_dx.data());
    point.signals(coefs.data(), moved.data(), moved_signals.data());
    for (std::size_t i = 0; i < states; ++i) {
      if (moved_dx[i] != dx[i]) drivers_[i].insert(j);
    }
    for (std::size_t i = 0; i < signals.size(); ++i) {
      if (moved_signals[i] != signals[i]) signal_drivers_[i].insert(j);
    }
  }
}

// What changes the force's direction is seen by look() where a flank touches, and counts here
// wherever the direction itself does.
void Structure::look_at_contact(const PreparedPoint& point, const std::vector<double>& coefs,
                                const std::vector<double>& x) {
  std::vector<double> direction(x.size()), gradient(x.size());
  for (const ContactLimit& limit : model_.contact_limits()) {
    point.force_direction(limit.contact, coefs.data(), x.data(), direction.data());
    point.penetration_gradient(limit, coefs.data(), x.data(), gradient.data());
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (gradient[j] == 0.0) continue;
      contact_drivers_.insert(j);
      for (std::size_t i = 0; i < x.size(); ++i) {
        if (direction[i] != 0.0) drivers_[i].insert(j);
      }
    }
  }
}

std::set<std::size_t> Structure::drivers_of_signal(std::size_t signal) const {
  std::set<std::size_t> drivers = signal_drivers_[signal];
  drivers.insert(contact_drivers_.begin(), contact_drivers_.end());
  return drivers;
}

std::set<std::size_t> Structure::closure(std::set<std::size_t> states) const {
  std::vector<std::size_t> open(states.begin(), states.end());
  while (!open.empty()) {
    const std::size_t state = open.back();
    open.pop_back();
    for (const std::size_t driver : drivers_[state]) {
      if (states.insert(driver).second) open.push_back(driver);
    }
  }
  return states;
}

bool Structure::leaves_constant_block(const Reduction& reduction) const {
  const std::size_t states = model_.states.size();
  std::vector<double> jacobian(states * states), dx(states);
  for (const ModelSetting& setting : settings_) {
    const std::unique_ptr<PreparedPoint> point = model_.prepare(setting);
    std::vector<double> first;
    for (Sample& sample : samples_of(model_, setting)) {
      for (const auto [kept, mirrored] : reduction.mirrors) sample.x[mirrored] = -sample.x[kept];
      point->jacobian(sample.coefs.data(), sample.x.data(), jacobian.data());
      const std::vector<double> block = block_of(reduction, jacobian, states);
      if (first.empty()) first = block;
      if (!are_alike(block, first, max_size(jacobian))) return false;
      point->rhs(sample.coefs.data(), sample.x.data(), dx.data());
      for (const auto [kept, mirrored] : reduction.mirrors) {
        if (!are_alike({dx[kept]}, {-dx[mirrored]}, max_size(dx))) return false;
      }
    }
  }
  return true;
}

std::vector<double> left_out_block(const Model& reduced, const ModelSetting& setting) {
  const Model& whole = *reduced.whole;
  const std::size_t states = whole.states.size();
  std::vector<double> jacobian(states * states), coefs(whole.phase_coefs.size());
  std::vector<double> x = whole.equilibrium(setting);
  for (const auto [kept, mirrored] : reduced.reduction.mirrors) x[mirrored] = -x[kept];
  whole.phase_coefs_at(setting, 0.0, 1e-9, coefs.data());
  whole.prepare(setting)->jacobian(coefs.data(), x.data(), jacobian.data());
  return block_of(reduced.reduction, jacobian, states);
}

}  // namespace gearsweep
