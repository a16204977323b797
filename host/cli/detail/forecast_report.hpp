// What a sweep will take, in words.
#pragma once

#include <string>

#include "sweep/forecast.hpp"

namespace gearsweep {

std::string describe_forecast(const Forecast& forecast, const std::string& output);
std::string forecast_as_json(const Forecast& forecast);

}  // namespace gearsweep
