// What is known at the point nearest to the pointer.

import { nearestPoint, tileValue } from "./tiles.js";
import { cellShares } from "./view.js";
import { short } from "./ticks.js";

export function statusText(status) {
  return status === 0 ? "ok" : status === 1 ? "diverged" : "status " + status;
}

// The point, its coordinates and its values, or null where nothing is there yet.
export function pointAt(cache, scene, axes, view, x, y) {
  const found = scene ? nearestPoint(cache, scene.key, view, x, y) : null;
  if (!found) return null;
  const [sx, sy] = cellShares(found.cell);
  const coordinates = { [axes[0].name]: axes[0].value(sx), [axes[1].name]: axes[1].value(sy) };
  const values = {};
  scene.quantities.forEach((quantity, k) => {
    values[quantity.name] = tileValue(found.tile, k, found.index);
  });
  return { cell: found.cell, coordinates, values, status: found.tile.data[found.index] };
}

export function valueText(quantity, value) {
  if (Number.isNaN(value)) return "no value";
  if (quantity.classes) return quantity.classes[value] || "class " + value;
  return short(value, 7) + (quantity.unit ? " " + quantity.unit : "");
}

export class Readout {
  constructor(element, live) {
    this.element = element;
    this.live = live;
    this.timer = 0;
    this.text = "";
  }

  show(point, scene, axes, shown) {
    const rows = [];
    if (point) {
      for (const axis of axes) rows.push([axis.title, String(point.coordinates[axis.name])]);
      for (const quantity of scene.quantities) {
        rows.push([quantity.name, valueText(quantity, point.values[quantity.name]), quantity.name === shown]);
      }
      rows.push(["status", statusText(point.status)]);
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
