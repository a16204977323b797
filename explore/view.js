// The part of the world that the map shows, in shares 0..1 of each axis. Rows grow upwards.

export const tileCells = 32;

export class View {
  constructor() {
    this.x0 = 0;
    this.y0 = 0;
    this.sx = 1;
    this.sy = 1;
    this.width = 1;
    this.height = 1;
    this.maxDepth = 46;
  }

  get x1() { return this.x0 + this.sx; }
  get y1() { return this.y0 + this.sy; }

  set(rectangle) {
    this.x0 = rectangle.x0;
    this.y0 = rectangle.y0;
    this.sx = rectangle.sx;
    this.sy = rectangle.sy;
    this.clamp();
  }

  copy() {
    return { x0: this.x0, y0: this.y0, sx: this.sx, sy: this.sy };
  }

  // The centre stays inside the world, and the smallest cell stays below 16 pixels.
  clamp() {
    const finest = 2 ** (this.maxDepth + 5);
    const fit = (from, span, pixels) => {
      const wanted = Math.min(1.2, Math.max(span, pixels / 16 / finest));
      const centre = Math.min(1, Math.max(0, from + span / 2));
      const kept = wanted === span && centre === from + span / 2;
      return [kept ? from : centre - wanted / 2, wanted];
    };
    [this.x0, this.sx] = fit(this.x0, this.sx, this.width);
    [this.y0, this.sy] = fit(this.y0, this.sy, this.height);
  }

  toShare(px, py) {
    return [this.x0 + px / this.width * this.sx, this.y0 + (this.height - py) / this.height * this.sy];
  }

  toPixelX(share) { return (share - this.x0) / this.sx * this.width; }
  toPixelY(share) { return this.height - (share - this.y0) / this.sy * this.height; }

  pan(dx, dy) {
    this.x0 -= dx / this.width * this.sx;
    this.y0 += dy / this.height * this.sy;
    this.clamp();
  }

  // The share under the pixel stays under it.
  zoom(px, py, factorX, factorY) {
    const [x, y] = this.toShare(px, py);
    const finest = 2 ** (this.maxDepth + 5);
    const sx = Math.min(1.2, Math.max(this.sx * factorX, this.width / 16 / finest));
    const sy = Math.min(1.2, Math.max(this.sy * factorY, this.height / 16 / finest));
    this.x0 = x - px / this.width * sx;
    this.y0 = y - (this.height - py) / this.height * sy;
    this.sx = sx;
    this.sy = sy;
    this.clamp();
  }

  // The depth with about one point a pixel. With unequal zooms it is the mean of both axes.
  targetDepth() {
    const wanted = Math.sqrt(this.width * this.height / (this.sx * this.sy)) / tileCells;
    let depth = Math.min(this.maxDepth, Math.max(0, Math.round(Math.log2(wanted))));
    // A view much longer than wide needs whole tiles across; it must not need too many along.
    const most = 2 * this.width * this.height / (tileCells * tileCells) + 8;
    while (depth > 0 && this.tileCount(depth) > most) depth--;
    return depth;
  }

  // The deepest depth at which one tile is as large as the view.
  coarsestDepth() {
    return Math.min(this.maxDepth, Math.max(0, Math.floor(-Math.log2(Math.max(this.sx, this.sy)))));
  }

  // First and last tile of each axis at a depth. A cell reaches half a cell to each side of its point.
  tileRange(depth) {
    const cells = 2 ** (depth + 5);
    const cell = (share) => Math.min(cells - 1, Math.max(0, Math.floor(share * cells + 0.5)));
    const tile = (share) => Math.floor(cell(share) / tileCells);
    return { i0: tile(this.x0), i1: tile(this.x1), j0: tile(this.y0), j1: tile(this.y1) };
  }

  tileCount(depth) {
    const range = this.tileRange(depth);
    return (range.i1 - range.i0 + 1) * (range.j1 - range.j0 + 1);
  }

  // The edges of a tile in whole pixels, so that neighbours leave no seam.
  tileBox(depth, i, j) {
    const cells = 2 ** (depth + 5);
    const left = Math.round(this.toPixelX((i * tileCells - 0.5) / cells));
    const right = Math.round(this.toPixelX((i * tileCells + 31.5) / cells));
    const bottom = Math.round(this.toPixelY((j * tileCells - 0.5) / cells));
    const top = Math.round(this.toPixelY((j * tileCells + 31.5) / cells));
    return { left, top, width: right - left, height: bottom - top };
  }

  // The cell of a depth nearest to a share. Share 1 belongs to no cell.
  cellAt(depth, x, y) {
    const cells = 2 ** (depth + 5);
    const nearest = (share) => Math.min(cells - 1, Math.max(0, Math.round(share * cells)));
    return { depth: depth + 5, kx: nearest(x), ky: nearest(y) };
  }

  inWorld(x, y) {
    const slack = 1 / 2 ** (this.targetDepth() + 6);
    return x >= -slack && x <= 1 + slack && y >= -slack && y <= 1 + slack;
  }
}

// The shares of a cell. Both are exact.
export function cellShares(cell) {
  const cells = 2 ** cell.depth;
  return [cell.kx / cells, cell.ky / cells];
}
