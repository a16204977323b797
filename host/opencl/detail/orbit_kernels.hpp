// The search for periodic orbits on a device: kernels/orbit.cl, and replay of sweep.cl.
#pragma once

#include "engine/engine.hpp"
#include "opencl/detail/launcher.hpp"

namespace gearsweep {

class OrbitKernels final : public OrbitEngine {
 public:
  // sweep: the study's own program.
  OrbitKernels(const Study& study, const cl::Program& sweep, Launcher* launcher);

  std::optional<Approach> approach(const Plan& plan, const Tile& tile,
                                   const std::vector<double>& states, std::size_t periods,
                                   const std::vector<std::uint32_t>& excluded,
                                   const NearReturn& near,
                                   const RoundCallback& after_round) override;
  std::optional<Sections> follow(const Plan& plan, const Tile& tile,
                                 const std::vector<double>& states,
                                 const std::vector<std::uint32_t>& lengths,
                                 const RoundCallback& after_round) override;
  std::optional<ReturnMaps> return_maps(const Plan& plan, const Tile& tile,
                                        const std::vector<double>& states,
                                        const std::vector<std::uint32_t>& lengths,
                                        const RoundCallback& after_round) override;
  std::optional<TileResult> replay(const Plan& plan, const Tile& tile,
                                   const std::vector<double>& states, std::size_t length,
                                   const std::vector<double>& log_stretchings, const Window& window,
                                   const RoundCallback& after_round) override;

 private:
  // Runs a kernel that advances each point by its own number of periods, each step of which costs
  // so much. False when the callback asked to stop.
  bool run_lengths(cl::Kernel* kernel, const Plan& plan, const Tile& tile, const TileInputs& inputs,
                   const std::vector<std::uint32_t>& lengths, double cost,
                   const RoundCallback& after_round);

  Launcher* launcher_;
  cl::Program program_;
  cl::Kernel follow_, measure_, extrapolate_, return_map_linearized_, replay_, finish_;
};

}  // namespace gearsweep
