// The crosshair: a cell that the arrow keys move.

import { cellShares } from "./view.js";

export class Walker {
  constructor(view) {
    this.view = view;
    this.cell = null;
  }

  // The first step only shows the crosshair in the middle. Returns whether the view had to move.
  step(dx, dy) {
    const view = this.view;
    const from = this.cell ? cellShares(this.cell) : [view.x0 + view.sx / 2, view.y0 + view.sy / 2];
    const cell = view.cellAt(view.targetDepth(), from[0], from[1]);
    const last = 2 ** cell.depth - 1;
    if (this.cell) {
      cell.kx = Math.min(last, Math.max(0, cell.kx + dx));
      cell.ky = Math.min(last, Math.max(0, cell.ky + dy));
    }
    this.cell = cell;
    const [px, py] = this.pixel();
    if (px >= 0 && px <= view.width && py >= 0 && py <= view.height) return false;
    view.pan(view.width / 2 - px, view.height / 2 - py);
    return true;
  }

  // Where the keys act: at the crosshair, or in the middle.
  pixel() {
    if (!this.cell) return [this.view.width / 2, this.view.height / 2];
    const [x, y] = cellShares(this.cell);
    return [this.view.toPixelX(x), this.view.toPixelY(y)];
  }
}
