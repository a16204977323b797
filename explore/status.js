// The lines that tell how far the map is, and what is wrong.

const sentences = { export: null, refused: null, scene: null, tiles: null, diagram: null };

export function tellTrouble(banner, kind, text) {
  sentences[kind] = text;
  const shown = Object.values(sentences).find(Boolean) || "";
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

// Cells are as fine on both axes. Where one axis is zoomed far more, a cell is wider than the view.
function thinText(axes, view, depth) {
  const cells = 2 ** (depth + 5);
  const thin = axes.filter((axis, n) => [view.sx, view.sy][n] * cells < 1).map((axis) => axis.name);
  return thin.length === 0 ? ""
    : " Along " + thin.join(" and ") + " the view is thinner than a cell: the map shows points beside it.";
}

// A sentence on what comes before the tiles, or "".
export function comesFirst(keeper, previewer) {
  if (keeper.dragging) return "Previews, until the slider rests.";
  if (keeper.busy) return "A new scene is being prepared.";
  if (previewer.fileScene) return "The numbers of the file come first.";
  return previewer.busy ? "A quick preview comes first." : "";
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
  const depth = view.targetDepth();
  return text + thinText(axes, view, depth) + counts + digitsText(axes, view, depth);
}
