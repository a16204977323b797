// How exact a curve is, and what moves it.
#pragma once

#include <memory>
#include <vector>

#include "borders/border_curve.hpp"
#include "borders/map_borders.hpp"
#include "study/study.hpp"

namespace gearsweep {

class Engine;
class HostOrbitMap;

// What curves are judged with.
struct CurveJudge {
  const ParameterPlane& plane;
  const PeriodPixels& pixels;
  std::shared_ptr<const Study> study;  // with the steps of the curves
  Engine* engine = nullptr;            // of the study
  const std::atomic<bool>* stop = nullptr;
};

// Solves again at a few points of each curve with twice the steps: BorderCurve::step_error.
void find_step_errors(const CurveJudge& judge, std::vector<BorderCurve>* curves);

// Parameters that change together with one: of a reduced model in which states mirror each other
// the second of a pair of equal ones has no effect of its own.
std::vector<std::size_t> changed_together(const Model& model, std::size_t parameter);

// At the middle of each curve, where a stable motion bifurcates if there is such a place, the
// derivatives by all other parameters: BorderCurve::gradients.
void find_gradients(const CurveJudge& judge, std::vector<BorderCurve>* curves);

}  // namespace gearsweep
