// The lines that tell how far the map is, and what is wrong.

const sentences = { scene: null, tiles: null, export: null };

export function tellTrouble(banner, kind, text) {
  sentences[kind] = text;
  const shown = sentences.export || sentences.scene || sentences.tiles || "";
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

export function statusLine(axes, view, left, speed, sceneComes) {
  let text = "All points are there.";
  if (sceneComes) {
    text = "A new scene is being prepared.";
  } else if (left > 0) {
    text = "Computing: " + left + (left === 1 ? " tile" : " tiles") + " to come";
    text += speed > 0 ? ", about " + Math.round(speed).toLocaleString("en") + " points a second." : ".";
  }
  return text + digitsText(axes, view, view.targetDepth());
}
