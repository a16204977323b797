// What gear5 works out of the phase alone, for the host, in double: checks, breaks, tooth pairs,
// the start.

// The errors beyond the first harmonic, and those that come back once per turn.
struct Gear5Sine {
  double amplitude, order, phase;  // order: periods per mesh period
};

inline std::array<Gear5Sine, 9> gear5_sines(const ModelParameters& p) {
  return {{{p.e0_2, 2.0, p.e0_phase_2},
           {p.e0_3, 3.0, p.e0_phase_3},
           {p.e0_4, 4.0, p.e0_phase_4},
           {p.e0_5, 5.0, p.e0_phase_5},
           {p.e0_6, 6.0, p.e0_phase_6},
           {p.e0_7, 7.0, p.e0_phase_7},
           {p.e0_8, 8.0, p.e0_phase_8},
           {p.runout_p, 1.0 / std::round(p.zp), p.runout_phase_p},
           {p.runout_g, 1.0 / std::round(p.zp * p.teeth_ratio), p.runout_phase_g}}};
}

// What is wrong with a fault of a gear that comes back once per turn; empty if nothing.
inline std::string gear5_check_turn(const ModelParameters& p, const std::string& gear,
                                    double teeth) {
  const double whole = std::round(teeth);
  if (std::fabs(teeth - whole) > 1e-6) {
    return "a fault of the " + gear + " needs a whole number of teeth";
  }
  if (std::fmod(p.cycle, whole) == 0.0) return "";
  return "a fault of the " + gear + " comes back once per turn: cycle must be a multiple of its " +
         std::to_string(static_cast<long>(whole)) + " teeth";
}

// The first thing that is wrong with a set of parameters whose ranges are right; empty if nothing.
inline std::string model_check(const ModelParameters& p, const ModelOptions& options,
                               const ModelCurves& curves = {}) {
  if (std::fabs(p.rho_p + p.rho_g - 1.0) > 1e-6) return "rho_p + rho_g must be 1";
  if (options.formulation == FORMULATION_PRINTED && p.teeth_ratio != 1.0) {
    return "formulation 'printed' is for equal gears: teeth_ratio must be 1";
  }
  if (p.cycle != std::floor(p.cycle)) return "cycle must be a whole number";
  if (options.stiffness == STIFFNESS_TABLE && !curves.measured_stiffness.at) {
    return "stiffness 'table' needs a measured curve: stiffness_file in [gear]";
  }
  if (p.overlap > 0.0 && options.stiffness == STIFFNESS_TABLE && curves.load_share.at) {
    return "the load of helical teeth is shared slice by slice: overlap and load_share_file do not "
           "go together";
  }
  if (p.engagement > 0.0 && (p.overlap > 0.0 || options.stiffness > STIFFNESS_RECTANGULAR)) {
    return "engagement is for spur gears with the stiffness 'parabolic' or 'rectangular'";
  }
  const bool has_pitch = curves.pitch_p.at || curves.pitch_g.at;
  if (options.error != ERROR_SERIES && has_pitch) {
    return "pitch errors need the option error = 'series'";
  }
  if (options.error == ERROR_SERIES && p.zp * p.teeth_ratio < 0.5) {
    return "error = 'series' needs a gear of half a tooth or more: raise zp*teeth_ratio";
  }
  if (options.error != ERROR_SERIES) {
    for (const Gear5Sine& sine : gear5_sines(p)) {
      if (sine.amplitude != 0.0) return "e0_2 .. e0_8 and runout need the option error = 'series'";
    }
  }
  if (p.overlap > 0.0 && (curves.damage_curve_p.at || curves.damage_curve_g.at)) {
    return "damage over the path of contact is for spur gears: overlap must be 0";
  }
  std::string wrong;
  if (p.runout_p > 0.0 || p.damage_p > 0.0 || curves.pitch_p.at || curves.damage_curve_p.at)
    wrong = gear5_check_turn(p, "pinion", p.zp);
  if (!wrong.empty()) return wrong;
  if (p.runout_g > 0.0 || p.damage_g > 0.0 || curves.pitch_g.at || curves.damage_curve_g.at) {
    wrong = gear5_check_turn(p, "gear", p.zp * p.teeth_ratio);
  }
  if (!wrong.empty() || !curves.torque_swing.at) return wrong;
  const double teeth = std::round(p.zp);
  if (std::fabs(p.zp - teeth) > 1e-6) {
    return "the torque of a turn needs a whole number of teeth of the pinion";
  }
  if (std::fmod(p.cycle, teeth) == 0.0) return "";
  return "the torque of the pinion comes back once per turn: cycle must be a multiple of its " +
         std::to_string(static_cast<long>(teeth)) + " teeth";
}

// Phases in [0, 1) at which the right-hand side jumps or bends (0 is always one): in each mesh
// period a pair enters, a pair leaves, a pair passes the pitch point; of helical teeth, both ends
// of the face width do. Once per turn, a damaged tooth passes a bend of its curve.
inline std::vector<double> model_break_phases(const ModelParameters& p, const ModelOptions& options,
                                              const ModelCurves& curves = {}) {
  const double pitch = p.approach * p.eps;
  std::vector<double> breaks = {0.0, p.eps - 1.0, pitch < 1.0 ? pitch : pitch - 1.0};
  if (p.overlap > 0.0) {
    for (const double end : {p.overlap, p.eps + p.overlap, pitch + p.overlap}) {
      breaks.push_back(end - std::floor(end));
    }
  }
  if (p.engagement > 0.0) {
    for (const double end : {p.engagement, p.eps - p.engagement}) {
      breaks.push_back(end - std::floor(end));
    }
  }
  if (options.stiffness == STIFFNESS_TABLE) {
    for (const Curve* curve : {&curves.measured_stiffness, &curves.load_share}) {
      breaks.insert(breaks.end(), curve->jumps.begin(), curve->jumps.end());
    }
  }
  std::vector<double> phases;
  for (double begin = 0.0; begin < p.cycle; begin += 1.0) {
    for (const double phase : breaks) phases.push_back((begin + phase) / p.cycle);
  }
  const auto add_bends = [&](const Curve& damage, double teeth) {
    for (double begin = 0.0; begin < p.cycle; begin += std::round(teeth)) {
      for (const double place : damage.jumps) {
        const double phase = (begin + place * 2.0 * p.eps) / p.cycle;
        phases.push_back(phase - std::floor(phase));
      }
    }
  };
  if (!curves.damage_curve_p.jumps.empty()) add_bends(curves.damage_curve_p, p.zp);
  if (!curves.damage_curve_g.jumps.empty()) add_bends(curves.damage_curve_g, p.zp * p.teeth_ratio);
  return phases;
}

// What is left of the stiffness of a pair whose teeth may be damaged. The pair that enters at the
// beginning of the forcing period has both gears' teeth 0; `pair` counts on from there.
inline bool gear5_is_tooth_0(double pair, double teeth) {
  return std::fmod(pair, std::round(teeth)) == 0.0;
}
inline double gear5_sound_share(const ModelParameters& p, double pair) {
  double share = 1.0;
  if (p.damage_p > 0.0 && gear5_is_tooth_0(pair, p.zp)) share *= 1.0 - p.damage_p;
  if (p.damage_g > 0.0 && gear5_is_tooth_0(pair, p.zp * p.teeth_ratio)) share *= 1.0 - p.damage_g;
  return share;
}

// Likewise where the damage is a curve; place: on the path of contact, 0 to 1.
inline double gear5_sound_share_at(const ModelParameters& p, const ModelCurves& curves, double pair,
                                   double place) {
  double share = 1.0;
  if (curves.damage_curve_p.at && gear5_is_tooth_0(pair, p.zp)) {
    share *=
        1.0 - curves.damage_curve_p.at(0.5 * std::fmin(place, 1.0), 0.5 * std::fmin(place, 1.0));
  }
  if (curves.damage_curve_g.at && gear5_is_tooth_0(pair, p.zp * p.teeth_ratio)) {
    share *=
        1.0 - curves.damage_curve_g.at(0.5 * std::fmin(place, 1.0), 0.5 * std::fmin(place, 1.0));
  }
  return share;
}

// Stiffness kappa_i of a pair in contact at position s (in base pitches from its entry).
inline double gear5_pair_stiffness(const ModelParameters& p, int shape, double s) {
  // What the swelling over g base pitches at either end takes from the mean: the integrals of
  // 1 - u^2 (3 - 2 u) and of its first two moments are 1/2, 3/20 and 1/15.
  const double g = p.engagement, q = shape == STIFFNESS_RECTANGULAR ? 0.0 : p.q;
  const double r = 2.0 * g / p.eps;  // offset = r u - 1
  const double lost = 2.0 * g * ((1.0 - q) / 2.0 + q * (2.0 * r * 3.0 / 20.0 - r * r / 15.0));
  const double offset = (s - p.eps / 2.0) / (p.eps / 2.0);
  const double to_end = std::fmin(s, p.eps - s);
  const double u = to_end < g ? to_end / g : 1.0;
  return u * u * (3.0 - 2.0 * u) * (1.0 - q * offset * offset) / (p.eps * (1.0 - q / 3.0) - lost);
}

// Eq. (7): half of the Fourier series of the total stiffness, carried by each pair at all times.
inline double gear5_fourier_stiffness(const ModelParameters& p, double psi) {
  const double turn = TWO_PI * psi;
  return 0.5 *
         (1.0 + p.kappa * std::cos(turn + p.phase) + p.kappa_2 * std::cos(2.0 * turn + p.phase_2) +
          p.kappa_3 * std::cos(3.0 * turn + p.phase_3) +
          p.kappa_4 * std::cos(4.0 * turn + p.phase_4));
}

// All errors of `error` series but the first harmonic; turns: mesh periods since phase 0 of the
// forcing, at a place and inside of the segment that it is the end of.
inline void gear5_add_errors(const ModelParameters& p, const ModelCurves& curves, double turns,
                             double inside, PhaseCoefs* out) {
  const double turn = TWO_PI;
  for (const Gear5Sine& sine : gear5_sines(p)) {
    if (sine.amplitude == 0.0) continue;
    const double error = sine.amplitude * std::sin(turn * sine.order * turns + sine.phase);
    out->error += error;
    out->excitation += sine.order * sine.order * error;
  }
  const auto add_pitch = [&](const Curve& pitch, const Curve& bend, double teeth) {
    if (!pitch.at) return;
    const double order = 1.0 / std::round(teeth);
    out->error += pitch.at(order * turns, order * inside);
    out->excitation += order * order * bend.at(order * turns, order * inside);
  };
  add_pitch(curves.pitch_p, curves.pitch_bend_p, p.zp);
  add_pitch(curves.pitch_g, curves.pitch_bend_g, p.zp * p.teeth_ratio);
}

// Adds a pair in contact at position s, or a slice of it that is a share of its face width.
// lambda: its sliding direction.
inline void gear5_add_pair(const ModelParameters& p, bool printed, double s, double lambda,
                           double kappa, double share, PhaseCoefs* out) {
  // s_p/Rp = tan(alpha) + along and s_g/Rg = tan(alpha) - along Rp/Rg (Eq. 11).
  const double along = (s - p.approach * p.eps) * TWO_PI / p.zp;
  const double pinion_arm = out->tan_alpha + along;
  const double gear_arm = out->tan_alpha - along / p.teeth_ratio;
  const double arm = printed ? gear_arm : p.rho_p * pinion_arm + p.rho_g * gear_arm;
  const double slide_sign = printed ? -lambda : lambda;
  out->stiffness += share * kappa;
  out->lever += lambda * arm * (share * kappa);
  out->lever_damping += share * lambda * arm;
  out->slide += slide_sign * (share * kappa);
  out->slide_damping += share * slide_sign;
}

// Spur teeth: two pairs at most, each at one position.
inline void gear5_add_spur(const ModelParameters& p, const ModelOptions& options,
                           const ModelCurves& curves, bool is_sound, double period, double psi,
                           double inside, PhaseCoefs* out) {
  const bool printed = options.formulation == FORMULATION_PRINTED;
  const bool is_shared = options.stiffness == STIFFNESS_TABLE && curves.load_share.at;
  for (int pair = 0; pair < 2; ++pair) {
    const bool in_contact = inside + pair < p.eps;
    const double lambda = !in_contact ? 0.0 : inside + pair < p.approach * p.eps ? 1.0 : -1.0;
    double kappa = 0.0;
    if (options.stiffness == STIFFNESS_FOURIER) {
      kappa = gear5_fourier_stiffness(p, psi);
    } else if (is_shared) {
      const double last = curves.load_share.at(psi, inside);
      kappa = pair == 0 ? last : 1.0 - last;
    } else if (in_contact) {
      kappa = gear5_pair_stiffness(p, options.stiffness, psi + pair);
    }
    if (!is_sound) {
      kappa *= gear5_sound_share(p, period - pair);
      kappa *= gear5_sound_share_at(p, curves, period - pair, (psi + pair) / p.eps);
    }
    gear5_add_pair(p, printed, psi + pair, lambda, kappa, 1.0, out);
  }
}

// Helical teeth: the slices of a pair are spread over positions from s - overlap to s, and a pair
// has the mean of what they have. Gauss's two points are right for the cubics that are summed.
inline void gear5_add_helical(const ModelParameters& p, const ModelOptions& options, bool is_sound,
                              double period, double psi, PhaseCoefs* out) {
  const bool printed = options.formulation == FORMULATION_PRINTED;
  const double pitch = p.approach * p.eps;
  const double ends[] = {0.0, pitch, p.eps};
  for (double pair = 0.0; pair < p.eps + p.overlap; pair += 1.0) {
    const double sound = is_sound ? 1.0 : gear5_sound_share(p, period - pair);
    for (int side = 0; side < 2; ++side) {
      const double from = std::fmax(ends[side], psi + pair - p.overlap);
      const double to = std::fmin(ends[side + 1], psi + pair);
      if (!(to > from)) continue;
      const double half = 0.5 * (to - from);
      for (const double sign : {-1.0, 1.0}) {
        const double s = from + half * (1.0 + sign / std::sqrt(3.0));
        const double kappa = sound * gear5_pair_stiffness(p, options.stiffness, s);
        gear5_add_pair(p, printed, s, side == 0 ? 1.0 : -1.0, kappa, half / p.overlap, out);
      }
    }
  }
}

// All pairs, with their damage or as if they were sound.
inline void gear5_add_pairs(const ModelParameters& p, const ModelOptions& options,
                            const ModelCurves& curves, bool is_sound, double period, double psi,
                            double inside, PhaseCoefs* out) {
  if (p.overlap > 0.0) {
    gear5_add_helical(p, options, is_sound, period, psi, out);
  } else {
    gear5_add_spur(p, options, curves, is_sound, period, psi, inside, out);
  }
}

// Scales the stiffness of pairs that share `total` as they are, as damage leaves them.
inline void gear5_share_total(const ModelParameters& p, const ModelOptions& options,
                              const ModelCurves& curves, double period, double psi, double inside,
                              double total, PhaseCoefs* out) {
  PhaseCoefs shares = {};
  gear5_add_pairs(p, options, curves, true, period, psi, inside, &shares);
  const double factor = total / shares.stiffness;
  out->stiffness *= factor;
  out->lever *= factor;
  out->slide *= factor;
}

// Coefficients at phase `at` in [0, 1] of the forcing period, as the limit from the side of
// `inside`, a phase strictly between the two break phases that enclose it.
inline PhaseCoefs model_phase_coefs(const ModelParameters& p, const ModelOptions& options,
                                    double at, double at_inside, const ModelCurves& curves = {}) {
  const double turn = TWO_PI;
  const double period = std::floor(p.cycle * at_inside);  // of the mesh
  const double psi = p.cycle * at - period;
  const double inside = p.cycle * at_inside - period;
  const double radians = p.alpha * turn / 360.0;
  PhaseCoefs out = {};
  out.cos_alpha = std::cos(radians);
  out.sin_alpha = std::sin(radians);
  out.tan_alpha = std::tan(radians);
  out.sine = std::sin(turn * psi + p.e0_phase);
  if (options.error == ERROR_SERIES) {
    gear5_add_errors(p, curves, period + psi, period + inside, &out);
  }
  if (curves.torque_swing.at) {
    const double order = 1.0 / std::round(p.zp);
    out.torque =
        p.rho_p * curves.torque_swing.at(order * (period + psi), order * (period + inside));
  }
  gear5_add_pairs(p, options, curves, false, period, psi, inside, &out);
  const bool is_fourier = options.stiffness == STIFFNESS_FOURIER;
  // A table without its curve is what model_check() refuses.
  const bool is_table = options.stiffness == STIFFNESS_TABLE && curves.measured_stiffness.at;
  if (is_table || (is_fourier && p.overlap > 0.0)) {
    const double total = is_fourier ? 2.0 * gear5_fourier_stiffness(p, psi)
                                    : curves.measured_stiffness.at(psi, inside);
    gear5_share_total(p, options, curves, period, psi, inside, total, &out);
  }
  out.stiffness *= p.stiffness_factor;
  out.lever *= p.stiffness_factor;
  out.slide *= p.stiffness_factor;
  return out;
}

// Static equilibrium on the drive flank under F1 with the mean stiffness and no friction.
inline void model_equilibrium(const ModelParameters& p, const ModelOptions& options, double* x) {
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = 0.0;
  x[STATE_x3] = p.F1 / p.k2;
  x[STATE_x5] = -p.F1 / p.k4;
  ModelPoint point;
  model_prepare(&p, options, &point);
  ModelOptions plain = options;  // the angles alone are asked for
  plain.stiffness = STIFFNESS_PARABOLIC;
  plain.error = ERROR_SINE;
  const PhaseCoefs phase = model_phase_coefs(p, plain, 0.0, 1e-9);
  const double shafts = gear5_deflection(&point, 0.0, x[STATE_x3], x[STATE_x5]);
  x[STATE_x1] = gear5_backlash(&point, &phase, x) + p.F1 / p.stiffness_factor - shafts;
}
