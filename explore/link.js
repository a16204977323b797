// The state of the page in the link, and the history of the browser.

// What is drawn beside the colours: { contours, si, curves }.
export function drawnText(drawn) {
  return (drawn.contours ? "&" + new URLSearchParams({ contours: drawn.contours }) : "") +
    (drawn.si ? "&si=1" : "") + (drawn.curves ? "" : "&curves=0");
}

// pane: { along, state } of the diagram, or null.
export function encode(keeper, view, look, cell, pane, drawn) {
  const query = new URLSearchParams();
  const { sets, x, y } = keeper.changes();
  for (const [name, value] of sets) query.append("set", name + "=" + value);
  if (x !== null) query.set("x", x);
  if (y !== null) query.set("y", y);
  query.set("view", [view.x0, view.y0, view.sx, view.sy].join(","));
  query.set("q", look.quantity);
  if (look.scale !== "linear") query.set("scale", look.scale);
  if (look.scale === "fixed") query.set("ends", look.low + "," + look.high);
  if (look.palette !== "auto") query.set("palette", look.palette);
  if (cell) query.set("at", [cell.depth, cell.kx, cell.ky].join(","));
  if (cell && cell.curve !== undefined) query.set("curve", [cell.curve, cell.point].join(","));
  if (pane) query.set("diagram", pane.along);
  if (pane && pane.state !== "") query.set("state", pane.state);
  return "#" + query + drawnText(drawn);
}

function numbers(text, count) {
  const list = (text || "").split(",").map(Number);
  return text && list.length === count && list.every(Number.isFinite) ? list : null;
}

// of: the curve and its point that an open orbit is of, or null.
function cellOf(place, of) {
  if (!place) return null;
  const cell = { depth: place[0], kx: place[1], ky: place[2] };
  return of ? { ...cell, curve: of[0], point: of[1] } : cell;
}

export function decode(hash) {
  const query = new URLSearchParams(hash.replace(/^#/, ""));
  const sets = [];
  for (const text of query.getAll("set")) {
    const cut = text.lastIndexOf("=");
    const value = Number(text.slice(cut + 1));
    if (cut > 0 && Number.isFinite(value)) sets.push([text.slice(0, cut), value]);
  }
  const view = numbers(query.get("view"), 4);
  const ends = numbers(query.get("ends"), 2);
  const cell = cellOf(numbers(query.get("at"), 3), numbers(query.get("curve"), 2));
  const scale = ["log", "quantiles", "fixed"].includes(query.get("scale")) ? query.get("scale") : "linear";
  const look = { scale, palette: query.get("palette") || "auto" };
  if (query.get("q")) look.quantity = query.get("q");
  if (ends) Object.assign(look, { low: ends[0], high: ends[1] });
  return {
    changes: { sets, x: query.get("x"), y: query.get("y") },
    view: view && view[2] > 0 && view[3] > 0 ? { x0: view[0], y0: view[1], sx: view[2], sy: view[3] } : null,
    pane: query.has("diagram") ? { along: query.get("diagram"), state: query.get("state") || "" } : null,
    drawn: { contours: query.get("contours") || "", si: query.get("si") === "1",
      curves: query.get("curves") !== "0" },
    look, cell,
  };
}

// A view that has come to rest is an entry of the history. While it moves, one entry is rewritten.
export class History {
  constructor(hash, onSettled) {
    this.hash = hash;
    this.onSettled = onSettled;
    this.atRest = false;
    this.moving = false;
    this.timer = 0;
    this.longTimer = 0;
  }

  changed() {
    if (this.atRest && this.hash() !== location.hash) {
      history.pushState(null, "", this.hash());
      this.atRest = false;
    }
    this.moving = true;
    this.later();
  }

  // The state came from the link itself: there is nothing to write, but a view to remember.
  arrived() {
    this.atRest = false;
    this.moving = true;
    this.later();
  }

  later() {
    clearTimeout(this.timer);
    clearTimeout(this.longTimer);
    // Browsers allow few changes a second.
    this.timer = setTimeout(() => {
      this.timer = 0;
      history.replaceState(null, "", this.hash());
      if (this.isQuiet) this.settle();
    }, 600);
    this.isQuiet = false;
    // A slow map counts as seen after a while, finished or not.
    this.longTimer = setTimeout(() => this.settle(), 4000);
  }

  quiet() {
    this.isQuiet = true;
    if (this.moving && !this.timer) this.settle();
  }

  settle() {
    if (!this.moving) return;
    clearTimeout(this.longTimer);
    this.moving = false;
    this.atRest = true;
    history.replaceState(null, "", this.hash());
    this.onSettled();
  }
}
