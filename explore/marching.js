// Lines of equal values on a lattice, and borders between its classes. Lines are lists x, y, x, y, ...

// Edges of a cell, anticlockwise from the lower one, that a line joins; corners as bits from the lower
// left. Cases 5 and 10 are saddles.
const joins = [[], [3, 0], [0, 1], [3, 1], [1, 2], null, [0, 2], [3, 2], [2, 3], [2, 0], null, [2, 1],
  [1, 3], [1, 0], [0, 3], []];

// At a jump many levels lie in one cell. One line, the middle one, marks it.
function isHidden(level, levels, low, high) {
  const inside = levels.filter((one) => one > low && one <= high);
  return inside.length > 2 && level !== inside[inside.length >> 1];
}

// The two neighbours of each crossed edge.
function crossings(lattice, level, levels) {
  const { values } = lattice;
  const nx = lattice.xs.length;
  const ny = lattice.ys.length;
  const links = new Map();
  const join = (a, b) => {
    for (const [from, to] of [[a, b], [b, a]]) {
      const list = links.get(from);
      if (list) list.push(to);
      else links.set(from, [to]);
    }
  };
  for (let j = 0; j + 1 < ny; j++) {
    for (let i = 0; i + 1 < nx; i++) {
      const k = j * nx + i;
      const a = values[k];
      const b = values[k + 1];
      const c = values[k + nx + 1];
      const d = values[k + nx];
      const bits = (a > level ? 1 : 0) + (b > level ? 2 : 0) + (c > level ? 4 : 0) + (d > level ? 8 : 0);
      if (bits === 0 || bits === 15 || Number.isNaN(a + b + c + d)) continue;
      if (isHidden(level, levels, Math.min(a, b, c, d), Math.max(a, b, c, d))) continue;
      // An edge has the number of its lower or left point, twice, and one more when it goes up.
      const edges = [2 * k, 2 * (k + 1) + 1, 2 * (k + nx), 2 * k + 1];
      const ends = joins[bits];
      if (ends) {
        join(edges[ends[0]], edges[ends[1]]);
      } else {
        const high = (a + b + c + d) / 4 > level;
        const turned = high === (bits === 5);
        join(edges[0], edges[turned ? 1 : 3]);
        join(edges[2], edges[turned ? 3 : 1]);
      }
    }
  }
  return links;
}

// levels: all that are drawn, `level` among them.
export function levelLines(lattice, level, levels) {
  const { xs, ys, values } = lattice;
  const nx = xs.length;
  const links = crossings(lattice, level, levels);
  const place = (edge, line) => {
    const k = edge >> 1;
    const up = edge & 1;
    const i = k % nx;
    const j = Math.floor(k / nx);
    const from = values[k];
    const part = (level - from) / (values[up ? k + nx : k + 1] - from);
    line.push(up ? xs[i] : xs[i] + part * (xs[i + 1] - xs[i]),
      up ? ys[j] + part * (ys[j + 1] - ys[j]) : ys[j]);
  };
  const lines = [];
  const follow = (start) => {
    const line = [];
    let edge = start;
    while (edge !== undefined) {
      place(edge, line);
      const next = links.get(edge);
      links.delete(edge);
      const ahead = next.find((one) => links.has(one));
      // A closed line ends where it began.
      if (ahead === undefined && edge !== start && next.includes(start)) place(start, line);
      edge = ahead;
    }
    if (line.length > 2) lines.push(line);
  };
  for (const [edge, list] of [...links]) if (list.length === 1 && links.has(edge)) follow(edge);
  for (const edge of [...links.keys()]) if (links.has(edge)) follow(edge);
  return lines;
}

function middles(list) {
  return Float64Array.from({ length: list.length - 1 }, (_, k) => (list[k] + list[k + 1]) / 2);
}

// Straight pieces, each as long as the border goes on.
export function classBorders(lattice) {
  const { xs, ys, values } = lattice;
  const nx = xs.length;
  const ny = ys.length;
  const mx = middles(xs);
  const my = middles(ys);
  const lines = [];
  const differ = (a, b) => a === a && b === b && a !== b;
  for (let i = 0; i + 1 < nx; i++) {
    let from = -1;
    for (let j = 1; j < ny; j++) {
      const border = j + 1 < ny && differ(values[j * nx + i], values[j * nx + i + 1]);
      if (border && from < 0) from = j;
      if (border || from < 0) continue;
      lines.push([mx[i], my[from - 1], mx[i], my[j - 1]]);
      from = -1;
    }
  }
  for (let j = 0; j + 1 < ny; j++) {
    let from = -1;
    for (let i = 1; i < nx; i++) {
      const border = i + 1 < nx && differ(values[j * nx + i], values[(j + 1) * nx + i]);
      if (border && from < 0) from = i;
      if (border || from < 0) continue;
      lines.push([mx[from - 1], my[j], mx[i - 1], my[j]]);
      from = -1;
    }
  }
  return lines;
}
