// The bifurcation diagram below the map: along one of its axes, in step with its zoom.

import { findLine, markLine } from "./diagramline.js";
import { DiagramPicture } from "./diagrampicture.js";
import { DiagramReading } from "./diagramreading.js";
import { DiagramSide } from "./diagramside.js";
import { Loader } from "./loader.js";
import { columnsInView, nearestColumn, neededStrips, StripCache, targetDepth } from "./strips.js";
import { shownIn } from "./units.js";

const byId = (id) => document.getElementById(id);

export class Diagram {
  // app: view, scene(), axes(), quantity() -> its index, motionCell(), walkerCell(), pointer() -> shares on
  // the map or null, onFrame(), onMoved(), onState(), onOpen(cell), onHome(), onAnnounce(),
  // onUnknownScene(), onTrouble(text)
  constructor(app) {
    this.app = app;
    this.along = null;
    this.wanted = "";
    this.line = null;
    this.old = null;
    this.columns = [];
    this.picture = new DiagramPicture();
    this.reading = new DiagramReading(this);
    this.cache = new StripCache(128e6);
    this.loader = new Loader("diagram", 3, 128, {
      wanted: () => this.lacking(),
      wait: () => false,
      onRecord: (head, numbers, wanted) => {
        this.cache.put(wanted.name, head[1], head[2], numbers, head[7]);
        app.onFrame();
      },
      onChange: () => app.onFrame(),
      onTrouble: (text) => app.onTrouble(text),
      onUnknownScene: () => app.onUnknownScene(),
    });
    this.side = new DiagramSide((along, state) => {
      this.along = along;
      this.wanted = state;
      this.changed();
    });
    this.button = byId("diagram-button");
    this.button.addEventListener("click", () => this.toggle());
    new ResizeObserver(() => app.onFrame()).observe(byId("diagram-box"));
  }

  // What the loader is to ask for.
  lacking() {
    const { line } = this;
    if (!line) return null;
    return { name: line.name, places: neededStrips(this.cache, line, this.span(), this.focus()),
      request: (strips) => ({ scene: line.scene.key, axis: line.axis, at: [line.depth, line.k], strips }) };
  }

  get busy() { return this.along !== null && this.loader.busy; }

  get state() {
    return Math.max(0, this.app.scene().section.indexOf(this.wanted));
  }

  toggle() {
    this.along = this.along === null ? 0 : null;
    this.changed();
  }

  changed() {
    this.reading.leave();
    this.app.onState();
    this.refresh();
  }

  refresh() {
    if (this.along !== null) this.loader.refresh();
  }

  // What a link tells of the pane; null: nothing.
  link() {
    const scene = this.app.scene();
    if (this.along === null) return scene && scene.one_axis ? { along: "none", state: "" } : null;
    return { along: "xy"[this.along], state: this.wanted };
  }

  linkText() {
    const pane = this.link();
    return pane ? "&" + new URLSearchParams({ diagram: pane.along, state: pane.state }) : "";
  }

  // A study of one axis shows its diagram unless the link says otherwise.
  restore(pane) {
    const along = pane ? { x: 0, y: 1 }[pane.along] : this.app.scene().one_axis ? 0 : null;
    this.along = along === undefined ? null : along;
    this.wanted = pane ? pane.state : "";
    this.reading.leave();
    this.refresh();
    this.app.onFrame();
  }

  span() {
    const view = this.app.view;
    return this.along === 0 ? { from: view.x0, size: view.sx, pixels: view.width }
      : { from: view.y0, size: view.sy, pixels: view.width };
  }

  focus() {
    const share = this.reading.share();
    const span = this.span();
    return share === null ? span.from + span.size / 2 : share;
  }

  // The line follows the open motion, the crosshair and the view. What was drawn stays until there is more.
  follow() {
    const { app } = this;
    const scene = app.scene();
    const there = scene && scene.section && scene.section.length > 0;
    this.button.hidden = !there;
    const line = there && this.along !== null
      ? findLine(scene, app.axes(), app.view, this.along, app.motionCell(), app.walkerCell()) : null;
    if (line === this.line || line && this.line && line.name === this.line.name) return;
    const was = this.line;
    this.line = line;
    const sameAxis = line && was && line.axis === was.axis && ["name", "low", "high", "log"].every((field) =>
      line.scene.axes[line.axis][field] === was.scene.axes[was.axis][field]);
    if (!sameAxis) this.old = null;
    else if (!this.old || this.isCovered()) this.old = was;
    this.loader.refresh();
  }

  isCovered() {
    const span = this.span();
    const shown = Math.min(1, span.from + span.size) - Math.max(0, span.from);
    const wanted = shown * 2 ** (targetDepth(span, this.app.scene().max_depth) + 7);
    return this.columns.length >= Math.min(100, wanted / 6);
  }

  draw(style, ratio) {
    this.follow();
    const open = this.line !== null;
    byId("diagram").hidden = !open;
    byId("center").classList.toggle("with-diagram", open);
    byId("center").classList.toggle("one-axis", open && this.line.scene.one_axis === true);
    this.button.setAttribute("aria-pressed", String(open));
    if (!open) return;
    const scene = this.line.scene;
    const height = byId("diagram-box").clientHeight;
    const quantity = this.app.quantity();
    const lines = this.picture.lines(scene, quantity, style);
    const told = scene.choices.find((choice) => choice.name === scene.section[this.state]);
    this.side.show(this.line, this.app.axes(), this.state, lines, this.loader.left);
    const span = this.span();
    const now = [this.line.name, this.old && this.old.name, span.from, span.size, span.pixels, height, ratio,
      this.cache.stamp, this.state, quantity, style.back, shownIn(told).factor].join();
    if (now !== this.drawn && height > 60) {
      this.drawn = now;
      this.picture.draw({ axis: this.app.axes()[this.along], axisTicks: this.along === 1, span, height, ratio,
        style, lines, layers: this.layers(span), state: this.state, told });
    }
    this.reading.draw(span, height, style, ratio);
  }

  // What is drawn: the line before, faint, while this one has few columns, and this one.
  layers(span) {
    const layer = (line, strength) => ({ columns: columnsInView(this.cache, line, span), strength,
      quantities: line.scene.quantities.length });
    const present = layer(this.line, 1);
    this.columns = present.columns;
    const before = this.old && !this.isCovered() ? layer(this.old, 0.4) : null;
    if (!before || before.columns.length === 0) this.old = null;
    if (this.old) return [before, present];
    // Far in, a cell beside the view may be all there is, as large cells are on the map.
    const near = this.columns.length < 4 ? nearestColumn(this.cache, this.line, span) : null;
    return near ? [{ ...present, columns: [near], strength: 0.4, isWide: true }, present] : [present];
  }

  // The point of the map that the diagram is read at; null: none.
  point() {
    return this.line ? this.reading.point() : null;
  }

  // For tests of the page.
  told() {
    return { line: this.line && this.line.name, columns: this.columns.length, left: this.loader.left,
      milliseconds: this.picture.milliseconds, ranges: this.picture.ranges, old: this.old !== null };
  }

  // Over the map: where the line is, and where it is read.
  mark(canvas, ratio) {
    if (this.line) markLine(canvas, this.app.view, this.line, this.reading.share(), ratio);
  }
}
