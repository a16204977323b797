// Points that are no tiles: a preview of a view, or the numbers of the result file.

// Halfway between neighbours; the outer cells reach as far out as they reach in.
function edgesOf(shares, width) {
  const n = shares.length;
  const edges = new Float64Array(n + 1);
  for (let k = 1; k < n; k++) edges[k] = (shares[k - 1] + shares[k]) / 2;
  edges[0] = n > 1 ? 2 * shares[0] - edges[1] : shares[0] - width / 2;
  edges[n] = n > 1 ? 2 * shares[n - 1] - edges[n - 1] : shares[0] + width / 2;
  return edges;
}

// The column whose cell has the share, or -1.
function find(edges, share) {
  if (!(share >= edges[0] && share <= edges[edges.length - 1])) return -1;
  let low = 0;
  let high = edges.length - 2;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (edges[middle] <= share) low = middle;
    else high = middle - 1;
  }
  return low;
}

const overlap = (a0, a1, b0, b1) => Math.max(0, Math.min(a1, b1) - Math.max(a0, b0));

export class Grid {
  // xs, ys: the shares of columns and rows, growing. data: status, then each quantity, row by row.
  constructor(origin, xs, ys, data, width = 0.01) {
    this.origin = origin;
    this.xs = xs;
    this.ys = ys;
    this.data = data;
    this.size = xs.length * ys.length;
    this.xEdges = edgesOf(xs, width);
    this.yEdges = edgesOf(ys, width);
    const perShare = (edges) => (edges.length - 1) / (edges[edges.length - 1] - edges[0]);
    // As the depth of a cell: the mean of both axes.
    this.perShare = [perShare(this.xEdges), perShare(this.yEdges)];
    this.depth = Math.log2(this.perShare[0] * this.perShare[1]) / 2;
    this.first = null;
    this.values = null;  // of a file's columns and rows, as it has them
    this.canvas = null;
    this.stamp = -1;
    this.gaps = false;
  }

  value(quantity, index) { return this.data[(1 + quantity) * this.size + index]; }

  // The point whose cell has this place. Points of a file are no cells of a depth.
  nearest(x, y) {
    const column = find(this.xEdges, x);
    const row = find(this.yEdges, y);
    if (column < 0 || row < 0) return null;
    const cell = this.first && { depth: this.first.depth, kx: this.first.kx + column,
      ky: this.first.ky + row };
    const index = row * this.xs.length + column;
    const values = this.values && [this.values[0][column], this.values[1][row]];
    return { grid: this, index, shares: [this.xs[column], this.ys[row]], values, cell };
  }

  // How much of the view it covers. Beyond the ends of the axes there is nothing to cover.
  coverage(view) {
    const x0 = Math.max(0, view.x0);
    const y0 = Math.max(0, view.y0);
    const x1 = Math.min(1, view.x1);
    const y1 = Math.min(1, view.y1);
    return overlap(this.xEdges[0], this.xEdges[this.xs.length], x0, x1) *
      overlap(this.yEdges[0], this.yEdges[this.ys.length], y0, y1) / ((x1 - x0) * (y1 - y0));
  }

  // How many of its points are in the view.
  pointsIn(view) {
    const count = (list, from, to) => list.filter((share) => share >= from && share <= to).length;
    return count(this.xs, view.x0, view.x1) * count(this.ys, view.y0, view.y1);
  }
}

const grows = (list) => list.length > 0 && list.every((one, k) => k === 0 || one > list[k - 1]);

// From a record of POST preview.
export function previewGrid(head, numbers, quantities) {
  const [, depth, kx, ky, , , , nx] = head;
  const ny = numbers.length / nx / (1 + quantities);
  if (!(nx > 0) || !Number.isInteger(ny) || ny < 1) return null;
  const shares = (from, n) => Float64Array.from({ length: n }, (_, k) => (from + k) / 2 ** depth);
  const grid = new Grid("preview", shares(kx, nx), shares(ky, ny), numbers, 2 ** -depth);
  grid.first = { depth, kx, ky };
  return grid;
}

// From the record of GET data.
export function fileGrid(head, numbers, quantities) {
  const [nx, ny] = [head[5], head[6]];
  const lines = nx + ny;
  if (numbers.length !== 2 * lines + (1 + quantities) * nx * ny) return null;
  const xs = numbers.slice(0, nx);
  const ys = numbers.slice(nx, lines);
  if (!grows(xs) || !grows(ys)) return null;
  const grid = new Grid("file", xs, ys, numbers.subarray(2 * lines));
  grid.values = [numbers.slice(lines, lines + nx), numbers.slice(lines + nx, 2 * lines)];
  return grid;
}
