// Round places for ticks, and labels that stay short and distinct at every zoom.

export function short(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "no value";
  return String(Number(value.toPrecision(digits)));
}

function niceStep(range, count) {
  const raw = range / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const lead = raw / power;
  return { lead: lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10, power };
}

function plainLabel(value, step, largest) {
  if (Math.abs(value) < step * 1e-6) return "0";
  if (largest >= 1e6 || largest < 1e-4) {
    const place = (number) => Math.floor(Math.log10(number) + 1e-9);
    const digits = Math.min(20, Math.max(0, place(Math.abs(value)) - place(step)));
    return value.toExponential(digits).replace("e+", "e");
  }
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

// Ticks between two numbers: { base, ticks: [{ offset, label }] }; a tick stands at base + offset.
// Where labels would be long, they tell the distance from the base, and `from` is the base in letters.
export function linearTicks(low, high, count) {
  if (low > high) [low, high] = [high, low];
  const range = high - low;
  if (!(range > 0) || !Number.isFinite(range)) {
    return { base: low, ticks: [{ offset: 0, label: short(low) }], from: "" };
  }
  const { lead, power } = niceStep(range, Math.max(1, count));
  const step = lead * power;
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const digits = Math.ceil(Math.log10(largest / step));
  const far = digits > 5;
  const base = far ? Number(low.toPrecision(Math.min(17, Math.max(1, Math.floor(Math.log10(largest)) -
    Math.floor(Math.log10(power) + 1e-9))))) : 0;
  const ticks = [];
  const first = Math.ceil((low - base) / step - 1e-9);
  const last = Math.floor((high - base) / step + 1e-9);
  const exponent = Math.floor(Math.log10(power) + 0.5);
  for (let n = first; n <= last && ticks.length < 50; n++) {
    const offset = n * step;
    let label = plainLabel(offset, step, largest);
    if (far) label = n === 0 ? "+0" : (n > 0 ? "+" : "") + n * lead + "e" + exponent;
    ticks.push({ offset, label });
  }
  // One number is no scale.
  if (ticks.length < 2 && count < 8) return linearTicks(low, high, 2 * count);
  return { base, ticks, from: far ? String(base) : "" };
}

// Ticks for a logarithmic axis. A narrow view is as good as linear.
export function logTicks(low, high, count) {
  if (low > high) [low, high] = [high, low];
  const decades = Math.log10(high / low);
  if (!(decades >= 0.8 && decades < 700)) return linearTicks(low, high, count);
  const leads = decades * 3 <= count * 1.4 ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(decades / count));
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); e++) {
    if (leads.length === 1 && e % every !== 0) continue;
    for (const lead of leads) {
      const value = Number(lead + "e" + e);
      if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
      ticks.push({ offset: value, label: e < -3 || e > 5 ? lead + "e" + e : String(value) });
    }
  }
  return { base: 0, ticks, from: "" };
}
