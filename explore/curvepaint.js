// Draws bifurcation curves and their key as vectors, on a canvas or into SVG.

// A line of width 1 of a printed picture, in pixels: on a small map lines are thinner.
const keyUnit = 1.1;
const unitOf = (view) => Math.min(keyUnit, Math.max(0.65, view.width / 450));
// Points that were solved are marked where they are so far apart: between them a curve is drawn straight.
const dotPixels = 48;
const edge = 8;

// The shares of a line from a to b between which it is in the box of a view and its edge, or null. Only these
// are drawn: deep inside a map a dashed line would be billions of pixels long.
function insideView(view, ax, ay, bx, by) {
  let from = 0;
  let to = 1;
  for (const [at, way, most] of [[ax, bx - ax, view.width], [ay, by - ay, view.height]]) {
    if (way === 0) {
      if (at < -edge || at > most + edge) return null;
      continue;
    }
    const low = (-edge - at) / way;
    const high = (most + edge - at) / way;
    from = Math.max(from, Math.min(low, high));
    to = Math.min(to, Math.max(low, high));
  }
  return from <= to ? [from, to] : null;
}

// The parts of a stretch that are in view: [{ points: [x, y, ...], offset }], in pixels. offset: how long the
// stretch is before the part.
function partsInView(view, line, stretch) {
  const parts = [];
  let part = null;
  let length = 0;
  const [first, last] = stretch;
  for (let k = first; k < last; k++) {
    const ax = view.toPixelX(line.x[k]);
    const ay = view.toPixelY(line.y[k]);
    const bx = view.toPixelX(line.x[k + 1]);
    const by = view.toPixelY(line.y[k + 1]);
    const long = Math.hypot(bx - ax, by - ay);
    const seen = insideView(view, ax, ay, bx, by);
    if (!seen) part = null;
    else {
      const [from, to] = seen;
      if (!part || from > 0) {
        part = { points: [ax + from * (bx - ax), ay + from * (by - ay)], offset: length + from * long };
        parts.push(part);
      }
      part.points.push(ax + to * (bx - ax), ay + to * (by - ay));
      if (to < 1) part = null;
    }
    length += long;
  }
  return parts;
}

// lines: [{ kind, x, y, stretches }] with places as shares of the axes. All that is in view:
// [{ line, stable, points, offset }].
export function curvesInView(view, lines) {
  return lines.flatMap((line) => line.stretches.flatMap((stretch) => (
    partsInView(view, line, stretch).map((part) => ({ line, stable: stretch[2], ...part })))));
}

function dotsOf(view, line) {
  const dots = [];
  const n = line.x.length;
  for (let k = 0; k < n; k++) {
    const x = view.toPixelX(line.x[k]);
    const y = view.toPixelY(line.y[k]);
    if (x < -edge || y < -edge || x > view.width + edge || y > view.height + edge) continue;
    const far = [k - 1, k + 1].every((other) => other < 0 || other >= n ||
      Math.hypot(view.toPixelX(line.x[other]) - x, view.toPixelY(line.y[other]) - y) > dotPixels);
    if (far) dots.push([x, y]);
  }
  return dots;
}

function stroke(pen, points) {
  pen.beginPath();
  pen.moveTo(points[0], points[1]);
  for (let k = 2; k < points.length; k += 2) pen.lineTo(points[k], points[k + 1]);
  pen.stroke();
}

// A line of a stable motion: dashes over a white rim, which show on any colour.
function strokeRim(pen, told, points, unit) {
  pen.setLineDash([]);
  pen.strokeStyle = "#ffffff";
  pen.lineWidth = unit * told.rim;
  stroke(pen, points);
}

function strokeDashed(pen, told, style, points, offset, unit) {
  const dashes = style.dashes.map((length) => unit * told.width * length);
  const turn = dashes.reduce((sum, length) => sum + length, 0);
  pen.setLineDash(dashes);
  pen.lineDashOffset = turn > 0 ? offset % turn : 0;
  pen.strokeStyle = style.colour;
  pen.lineWidth = unit * told.width;
  stroke(pen, points);
  pen.setLineDash([]);
}

// told: what the server says of the curves. parts: curvesInView(). In the order of a printed picture: thin lines
// below, then the rims, then what is on them, kind by kind.
export function paintCurves(pen, view, told, parts) {
  const unit = unitOf(view);
  pen.lineJoin = "round";
  const ofKinds = told.styles.map((style) => [style, parts.filter((part) => part.line.kind === style.kind)]);
  for (const [style, own] of ofKinds) {
    pen.strokeStyle = style.colour;
    pen.lineWidth = unit * told.thin;
    pen.setLineDash([]);
    for (const part of own) if (!part.stable) stroke(pen, part.points);
  }
  for (const part of parts) if (part.stable) strokeRim(pen, told, part.points, unit);
  for (const [style, own] of ofKinds) {
    for (const part of own) {
      if (part.stable) strokeDashed(pen, told, style, part.points, part.offset, unit);
    }
  }
  for (const [style, own] of ofKinds) {
    for (const line of new Set(own.map((part) => part.line))) {
      for (const [x, y] of dotsOf(view, line)) {
        pen.fillStyle = "#ffffff";
        pen.fillRect(x - 3.5, y - 3.5, 7, 7);
        pen.fillStyle = style.colour;
        pen.fillRect(x - 2.5, y - 2.5, 5, 5);
      }
    }
  }
}

export const sampleWidth = 44;
const thinText = "thin: the motion is unstable";

// What the key has: [{ text, paint(pen, x, y) }], with the middle of a sample's left end at (x, y).
export function keyOf(told) {
  const entries = told.styles.map((style) => ({ text: style.kind, paint(pen, x, y) {
    const points = [x, y, x + sampleWidth, y];
    strokeRim(pen, told, points, keyUnit);
    strokeDashed(pen, told, style, points, 0, keyUnit);
  } }));
  if (!told.curves.some((curve) => curve.stretches.some((stretch) => !stretch[2]))) return entries;
  return [...entries, { text: thinText, paint(pen, x, y) {
    pen.setLineDash([]);
    pen.strokeStyle = "#808080";
    pen.lineWidth = keyUnit * told.thin;
    stroke(pen, [x, y, x + sampleWidth, y]);
  } }];
}

const entryWidth = 168;
const rowHeight = 20;

function columns(told, width) {
  return Math.max(1, Math.min(keyOf(told).length, Math.floor(width / entryWidth)));
}

// Of the key below a picture.
export function keyHeight(told, width) {
  return rowHeight * Math.ceil(keyOf(told).length / columns(told, width)) + 6;
}

export function paintKey(pen, told, width, style) {
  const across = columns(told, width);
  pen.font = style.font;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  keyOf(told).forEach((entry, k) => {
    const x = entryWidth * (k % across);
    const y = rowHeight * Math.floor(k / across) + 12;
    entry.paint(pen, x, y);
    pen.fillStyle = style.text;
    pen.fillText(entry.text, x + sampleWidth + 6, y, entryWidth - sampleWidth - 12);
  });
}
