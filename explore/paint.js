// Draws the map from the tiles and grids that are there, coarse ones below fine ones.

import { colorTile } from "./colors.js";
import { drawGrid } from "./gridpaint.js";
import { tileDepthAbove } from "./layers.js";
import { eachPlace, missingAt } from "./tiles.js";
import { cellShares } from "./view.js";

// Colouring may take this much of a frame. What is left keeps its old colours until the next frame.
const colorMilliseconds = 4;
// So long the old picture looks as before.
const dimMilliseconds = 500;

export function hatchPattern(context, style) {
  const canvas = document.createElement("canvas");
  canvas.width = 8;
  canvas.height = 8;
  const pen = canvas.getContext("2d");
  pen.fillStyle = style.hatchBack;
  pen.fillRect(0, 0, 8, 8);
  pen.strokeStyle = style.hatchLine;
  pen.lineWidth = 1.6;
  pen.beginPath();
  for (const shift of [-8, 0, 8]) {
    pen.moveTo(shift - 1, 9);
    pen.lineTo(shift + 9, -1);
  }
  pen.stroke();
  return context.createPattern(canvas, "repeat");
}

export class Painter {
  // later(milliseconds): a frame is wanted then
  constructor(canvas, cache, layers, later) {
    this.canvas = canvas;
    this.layers = layers;
    this.later = later;
    this.pen = canvas.getContext("2d", { alpha: false });
    this.cache = cache;
    this.stamp = 0;
    this.old = null;
    this.ratio = 1;
    this.lastMilliseconds = 0;
  }

  resize(width, height) {
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
  }

  // Keeps the picture of the present scene, to show it dimmed below the next one.
  keep(view, sameAxes) {
    const copy = document.createElement("canvas");
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    copy.getContext("2d").drawImage(this.canvas, 0, 0);
    // While a slider moves, pictures come one after another: only what stays is dimmed.
    const dimAt = performance.now() + (sameAxes ? dimMilliseconds : 0);
    this.old = { copy, rectangle: sameAxes ? view.copy() : null, dimAt };
  }

  recolor() { this.stamp++; }

  // Whether there is more to see than the ground.
  hasPicture(view, scene) {
    for (let depth = view.targetDepth(); depth >= 0; depth--) {
      let some = false;
      eachPlace(view, depth, (i, j) => { some = some || this.cache.has(scene, depth, i, j); });
      if (some) return true;
    }
    return this.layers.of(scene).length > 0;
  }

  // Returns whether another frame is needed.
  draw(view, scene, quantity, map, style) {
    const begun = performance.now();
    const pen = this.pen;
    this.cache.clock++;
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.imageSmoothingEnabled = false;
    pen.fillStyle = style.outside;
    pen.fillRect(0, 0, view.width, view.height);
    this.drawOld(view, style);
    if (scene === null || !map) return false;
    const target = view.targetDepth();
    let first = target;
    while (first > 0 && missingAt(this.cache, scene, view, first).length > 0) first--;
    const complete = missingAt(this.cache, scene, view, first).length === 0;
    const grids = this.layers.of(scene).filter((grid) => !complete || tileDepthAbove(grid, target) > first);
    if (complete || grids.some((grid) => grid.coverage(view) > 0.98)) this.old = null;
    const last = first === target ? target : Math.min(view.maxDepth, target + 1);
    if (this.styled !== style) {
      this.styled = style;
      this.pattern = hatchPattern(pen, style);
    }
    let again = false;
    for (let depth = first; depth <= last; depth++) {
      for (const grid of grids) {
        if (Math.max(first, tileDepthAbove(grid, target)) !== depth) continue;
        drawGrid(pen, grid, view, quantity, map, this.stamp, this.pattern);
      }
      eachPlace(view, depth, (i, j) => {
        const tile = this.cache.get(scene, depth, i, j);
        if (!tile) return;
        if (tile.stamp !== this.stamp) {
          if (performance.now() - begun < colorMilliseconds || !tile.canvas && depth === first) {
            colorTile(tile, quantity, map, this.stamp);
          } else {
            again = true;
          }
        }
        if (!tile.canvas) return;
        const box = view.tileBox(depth, i, j);
        if (tile.gaps) {
          pen.fillStyle = this.pattern;
          pen.fillRect(box.left, box.top, box.width, box.height);
        }
        pen.drawImage(tile.canvas, box.left, box.top, box.width, box.height);
      });
    }
    this.lastMilliseconds = performance.now() - begun;
    return again;
  }

  drawOld(view, style) {
    if (!this.old) return;
    const { copy, rectangle } = this.old;
    const pen = this.pen;
    const wait = this.old.dimAt - performance.now();
    if (wait > 0) this.later(wait);
    pen.globalAlpha = wait > 0 ? 1 : 0.45;
    if (rectangle) {
      const left = view.toPixelX(rectangle.x0);
      const top = view.toPixelY(rectangle.y0 + rectangle.sy);
      pen.drawImage(copy, left, top, view.toPixelX(rectangle.x0 + rectangle.sx) - left,
        view.toPixelY(rectangle.y0) - top);
    } else {
      pen.drawImage(copy, 0, 0, view.width, view.height);
    }
    pen.globalAlpha = 1;
    pen.fillStyle = style.outside;
  }
}

// The marks of a scene.
export function marksOf(motion, walker, scene) {
  const list = motion.pins.filter((pin) => pin.scene === scene.key).map((pin) => (
    { cell: pin.cell, kind: "ring", color: pin.color }));
  if (motion.cell) list.push({ cell: motion.cell, kind: "ring", color: motion.color });
  if (walker.cell) list.push({ cell: walker.cell, kind: "cross", color: "#fff" });
  return list;
}

// Marks over the map: the point of the open motion, the pins, and the crosshair of the keyboard.
export function drawMarks(canvas, view, marks, ratio) {
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, view.width, view.height);
  for (const mark of marks) {
    const [sx, sy] = cellShares(mark.cell);
    const x = Math.round(view.toPixelX(sx)) + 0.5;
    const y = Math.round(view.toPixelY(sy)) + 0.5;
    if (x < -20 || y < -20 || x > view.width + 20 || y > view.height + 20) continue;
    const path = new Path2D();
    if (mark.kind === "cross") {
      path.moveTo(x - 1e4, y);
      path.lineTo(x - 5, y);
      path.moveTo(x + 5, y);
      path.lineTo(x + 1e4, y);
      path.moveTo(x, y - 1e4);
      path.lineTo(x, y - 5);
      path.moveTo(x, y + 5);
      path.lineTo(x, y + 1e4);
    } else {
      path.arc(x, y, 6, 0, 7);
    }
    // Two strokes, so that the mark shows on every colour.
    pen.lineWidth = 4;
    pen.strokeStyle = "rgba(0,0,0,0.75)";
    pen.stroke(path);
    pen.lineWidth = 2;
    pen.strokeStyle = mark.color;
    pen.stroke(path);
  }
}
