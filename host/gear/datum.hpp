// What the numbers of a drawing rest on: whoever reads results must know which of them were
// guessed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

class GearDrawing;
struct GearKey;

enum class DatumOrigin : std::uint8_t { given, estimated, by_default };

// What a key of the drawing comes to.
struct GearDatum {
  std::string_view key;
  std::string value;  // in the key's unit: "1.2, 3.4", one number where all are the same
  DatumOrigin origin = DatumOrigin::given;
  std::string reason;   // how an estimate or a default came about; may be empty
  std::string drawing;  // of several drawings: the name of this one
};

// What is worked out where the drawing has no number of its own.
struct WorkedOut {
  std::vector<double> mass, inertia;  // kg, kg mm^2; empty where none is needed
  double stiffness = 0.0;             // N/m
  double centre = 0.0;                // mm
  double contact_ratio = 0.0;
  double torque = 0.0;  // N m
};

// In the order of the keys. is_taken: whether the model has what a key gives. A damping ratio and
// what the drawing calls an estimate are estimates, and so are the bodies of steel discs and the
// stiffness of ISO 6336-1.
std::vector<GearDatum> data_of(const GearDrawing& drawing, const WorkedOut& worked_out,
                               const std::function<bool(const GearKey&)>& is_taken);

}  // namespace gearsweep
