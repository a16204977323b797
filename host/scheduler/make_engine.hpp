// The engines that a study asks for.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/device_choice.hpp"
#include "engine/engine.hpp"
#include "engine/warn.hpp"
#include "scheduler/scheduler.hpp"

namespace gearsweep {

// Without a choice, the default device. The scheduler outlives it. Throws InputError or
// RunError.
std::unique_ptr<Engine> make_engine(const Study& study, std::optional<DeviceChoice> choice,
                                    Scheduler* scheduler);

// For each of these devices (none: the default one) that can be had, one, or a few for a study of
// several tiles, of which the device then computes as many at a time; the others are told of.
// Throws InputError or RunError when there is none at all.
std::vector<std::unique_ptr<Engine>> make_engines(const Study& study,
                                                  const std::vector<DeviceChoice>& devices,
                                                  Scheduler* scheduler, const Warn& warn);

}  // namespace gearsweep
