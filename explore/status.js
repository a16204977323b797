// The lines that tell how far the map is, and what is wrong.

const sentences = { scene: null, tiles: null, diagram: null, export: null };

export function tellTrouble(banner, kind, text) {
  sentences[kind] = text;
  const shown = sentences.export || sentences.scene || sentences.tiles || sentences.diagram || "";
  banner.hidden = shown === "";
  if (banner.textContent !== shown) banner.textContent = shown;
}

function digitsText(axes, view, depth) {
  const places = [0.1, 0.3, 0.5, 0.7, 0.9];
  const from = [view.x0, view.y0];
  const span = [view.sx, view.sy];
  const same = axes.filter((axis, n) => (
    places.some((part) => axis.exhausted(from[n] + part * span[n], depth))));
  if (same.length === 0) return depth === view.maxDepth ? " This is the finest depth." : "";
  return " Neighbouring cells have the same number on " + same.map((axis) => axis.name).join(" and ") +
    ": deeper shows no more.";
}

// first: a sentence that says what comes before the tiles, or "". counts: about the points in view.
export function statusLine(axes, view, left, speed, first, counts) {
  let text = "All points are there.";
  if (first !== "") {
    text = first;
  } else if (left > 0) {
    text = "Computing: " + left + (left === 1 ? " tile" : " tiles") + " to come";
    text += speed > 0 ? ", about " + Math.round(speed).toLocaleString("en") + " points a second." : ".";
  }
  return text + counts + digitsText(axes, view, view.targetDepth());
}
