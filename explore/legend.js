// The colour bar or the list of classes, and what the hatches mean.

import { classColor, css, paletteColor, shareOnBar, valueOnBar } from "./colors.js";
import { hatchPattern } from "./paint.js";
import { linearTicks, logTicks, short } from "./ticks.js";
import { shownIn } from "./units.js";

export const legendWidth = 128;

function swatch(pen, y, fill, text, style) {
  pen.fillStyle = fill;
  pen.fillRect(4, y, 18, 14);
  pen.strokeStyle = style.text;
  pen.lineWidth = 1;
  pen.strokeRect(4.5, y + 0.5, 17, 13);
  pen.fillStyle = style.text;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.fillText(text, 28, y + 8, legendWidth - 30);
}

// The lines of text above the hatches: what statistics limit, and what the contours are.
function notes(about, factor) {
  const lines = [];
  if (about.error !== null && about.error !== undefined) {
    const error = about.error * factor;
    const text = error > 0 && error < 1e-3 ? error.toExponential(1) : short(error, 2);
    lines.push("error of a point:", text + " (median)");
  }
  if (about.contours) lines.push("lines: " + about.contours);
  return lines;
}

function barTicks(map, height, factor) {
  if (map.flat !== undefined) return [{ share: 0.5, label: short(map.flat * factor, 6) }];
  const count = Math.max(2, height / 45);
  if (map.kind === "quantiles") {
    return [0, 0.25, 0.5, 0.75, 1].map((share) => (
      { share, label: short(valueOnBar(map, share) * factor, 4) }));
  }
  const find = map.kind === "log" ? logTicks : linearTicks;
  const found = find(map.low * factor, map.high * factor, count);
  const ticks = found.ticks.map((tick) => ({ share: shareOnBar(map, (found.base + tick.offset) / factor),
    label: found.from === "" ? tick.label : short(found.base + tick.offset, 10) }));
  // A short bar may hit no round number, or too many to write.
  if (ticks.length < 2 || ticks.length * 12 > height) {
    if (ticks.length > 1) ticks.length = 0;
    for (const share of [0, 1]) ticks.push({ share, label: short(valueOnBar(map, share) * factor, 4) });
  }
  return ticks;
}

// about: quantity, map, error (of a point, or null), contours (a title, or "").
// Returns the legend in words, for those who do not see it.
export function paintLegend(pen, about, height, style) {
  const { quantity, map } = about;
  const { title, factor } = shownIn(quantity);
  const lines = notes(about, factor);
  pen.font = style.font;
  pen.fillStyle = style.text;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.fillText(title, 4, 8, legendWidth - 6);
  const hatchTop = height - 44;
  const notesTop = hatchTop - 17 * lines.length - (lines.length > 0 ? 6 : 0);
  let words = title + ". ";
  if (map.kind === "classes") {
    const step = Math.min(22, (notesTop - 26) / Math.max(1, map.classes.length));
    map.classes.forEach((name, k) => swatch(pen, 22 + k * step, css(classColor(k)), name, style));
    words += map.classes.join(", ");
  } else {
    const top = 24;
    const bar = notesTop - top - 16;
    for (let y = 0; y < bar; y++) {
      pen.fillStyle = css(paletteColor(map.palette, 1 - (y + 0.5) / bar));
      pen.fillRect(4, top + y, 20, 1.5);
    }
    pen.strokeStyle = style.text;
    pen.lineWidth = 1;
    pen.strokeRect(4.5, top + 0.5, 19, bar);
    pen.fillStyle = style.text;
    pen.beginPath();
    for (const tick of barTicks(map, bar, factor)) {
      if (!(tick.share > -1e-9 && tick.share < 1 + 1e-9)) continue;
      const y = Math.round(top + (1 - tick.share) * bar) + 0.5;
      pen.moveTo(24, y);
      pen.lineTo(29, y);
      pen.fillText(tick.label, 32, y, legendWidth - 34);
    }
    pen.stroke();
    const end = (share) => short(valueOnBar(map, share) * factor, 4);
    words += "Colours from " + end(0) + " to " + end(1) + ", " + map.kind;
  }
  pen.fillStyle = style.text;
  lines.forEach((line, k) => pen.fillText(line, 4, notesTop + 8 + 17 * k, legendWidth - 6));
  const pattern = hatchPattern(pen, style);
  swatch(pen, hatchTop, pattern, "no value", style);
  swatch(pen, hatchTop + 20, pattern, "diverged", style);
  pen.fillStyle = "rgba(0,0,0,0.44)";
  pen.fillRect(5, hatchTop + 21, 16, 12);
  if (lines.length > 0) words += ". " + lines.join(" ");
  return words + ". Hatched: no value; dark hatched: diverged.";
}

export function drawLegend(canvas, about, height, style, ratio) {
  canvas.width = Math.round(legendWidth * ratio);
  canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  canvas.setAttribute("aria-label", "Legend: " + paintLegend(pen, about, height, style));
}
