// What is known at the point nearest to the pointer.

import { tileDepthAbove } from "./layers.js";
import { nearestPoint, tileValue } from "./tiles.js";
import { cellShares } from "./view.js";
import { short } from "./ticks.js";
import { siText, unitText } from "./units.js";

export function statusText(status) {
  return {
    0: "ok", 1: "diverged", 2: "starts at an unstable equilibrium",
    3: "its steps are too long to follow the motion", 255: "refused",
  }[status] || "status " + status;
}

// The point, its coordinates and its values, or null where nothing is there yet.
// The cell is null where a point of the file is on no cell.
export function pointAt(cache, layers, scene, axes, view, x, y) {
  if (!scene) return null;
  const tile = nearestPoint(cache, scene.key, view, x, y);
  const least = tile ? tile.cell.depth - 5 : -1;
  const found = gridPoint(layers, scene, view, x, y, least) || tile;
  if (!found) return null;
  const { grid } = found;
  const [sx, sy] = grid ? found.shares : cellShares(found.cell);
  const [x0, y0] = found.values || [axes[0].value(sx), axes[1].value(sy)];
  const coordinates = { [axes[0].name]: x0, [axes[1].name]: y0 };
  const values = {};
  scene.quantities.forEach((quantity, k) => {
    values[quantity.name] = grid ? grid.value(k, found.index) : tileValue(found.tile, k, found.index);
  });
  const status = (grid || found.tile).data[found.index];
  return { cell: found.cell, coordinates, values, status, origin: grid ? grid.origin : "tile" };
}

// The finest grid that is finer than the tiles there: the readout tells what the map shows.
function gridPoint(layers, scene, view, x, y, least) {
  let best = null;
  for (const grid of layers.of(scene.key)) {
    if (tileDepthAbove(grid, view.targetDepth()) > least) best = grid.nearest(x, y) || best;
  }
  return best;
}

const origins = { preview: "from the preview", file: "from the file" };

export function valueText(quantity, value) {
  if (Number.isNaN(value)) return "no value";
  if (quantity.classes) return quantity.classes[value] || "class " + value;
  return short(value, 7) + unitText(quantity) + siText(quantity, value);
}

export class Readout {
  constructor(element, live) {
    this.element = element;
    this.live = live;
    this.timer = 0;
    this.text = "";
  }

  // near: the curve at the pointer, or "".
  show(point, scene, axes, shown, near) {
    const rows = [];
    if (point) {
      for (const axis of axes) {
        const value = point.coordinates[axis.name];
        rows.push([axis.ownTitle, String(value) + siText(axis, value)]);
      }
      for (const quantity of scene.quantities) {
        rows.push([quantity.name, valueText(quantity, point.values[quantity.name]), quantity.name === shown]);
      }
      if (near) rows.push(["curve", near + ", a click opens its orbit", true]);
      rows.push(["status", statusText(point.status)]);
      if (origins[point.origin]) rows.push(["point", origins[point.origin]]);
    }
    const text = rows.map((row) => row[0] + " " + row[1]).join(", ");
    if (text === this.text && shown === this.shown) return;
    this.text = text;
    this.shown = shown;
    this.element.replaceChildren(...rows.map((row) => {
      const item = document.createElement("span");
      const name = document.createElement("b");
      name.textContent = row[0];
      item.append(name, " " + row[1]);
      if (row[2]) item.className = "shown";
      return item;
    }));
    if (!point) this.element.textContent = "Point at the map to read its numbers.";
  }

  // Screen readers hear the place of the keyboard, not each move of the mouse.
  announce() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => { this.live.textContent = this.text; }, 300);
  }
}
