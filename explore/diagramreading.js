// Reads a diagram: the pointer and the keyboard on it, and the numbers there.

import { placeIn } from "./diagramframe.js";
import { mapCell, shareAlong } from "./diagramline.js";
import { pinColor } from "./motion.js";
import { setUpPointer } from "./pointer.js";
import { cellOf, samplesAt, statusOf, targetDepth, valueOf } from "./strips.js";

const byId = (id) => document.getElementById(id);

export class DiagramReading {
  constructor(diagram) {
    this.diagram = diagram;
    this.pointer = null;
    this.cursor = null;
    setUpPointer(byId("diagram-plot"), this.acts());
  }

  leave() {
    this.pointer = null;
    this.cursor = null;
  }

  // Where the diagram is read, as a share of its axis; null: nowhere.
  share() {
    const { from, size, pixels } = this.diagram.span();
    if (this.pointer) return from + this.pointer[0] / pixels * size;
    return this.cursor ? this.cursor.k / 2 ** this.cursor.depth : null;
  }

  finestCell(share) {
    const depth = targetDepth(this.diagram.span(), this.diagram.line.scene.max_depth) + 7;
    return { depth, k: Math.min(2 ** depth - 1, Math.max(0, Math.round(share * 2 ** depth))) };
  }

  // The nearest column that is there, not too far away.
  column() {
    const share = this.share();
    const { columns } = this.diagram;
    if (share === null || columns.length === 0) return null;
    let low = 0;
    let high = columns.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (columns[middle].share < share) low = middle + 1;
      else high = middle;
    }
    const before = columns[Math.max(0, low - 1)];
    const after = columns[low];
    const best = share - before.share < after.share - share ? before : after;
    const { size, pixels } = this.diagram.span();
    const spacing = pixels / Math.max(1, columns.length);
    return Math.abs(best.share - share) / size * pixels <= Math.max(6, 2 * spacing) ? best : null;
  }

  // The same as the map tells of a point.
  point() {
    const column = this.column();
    if (!column) return null;
    const { line, app } = this.diagram;
    const axes = app.axes();
    const coordinates = {};
    coordinates[axes[line.axis].name] = axes[line.axis].value(column.share);
    coordinates[axes[1 - line.axis].name] = axes[1 - line.axis].value(line.share);
    const values = {};
    line.scene.quantities.forEach((quantity, k) => { values[quantity.name] = valueOf(column, k); });
    return { cell: mapCell(line, cellOf(column)), coordinates, values, status: statusOf(column) };
  }

  // The sample nearest to the pointer; of the keyboard, the last one.
  sample(column) {
    if (statusOf(column) !== 0) return null;
    const { diagram } = this;
    const { data, samples } = column.strip;
    const from = samplesAt(column, diagram.line.scene.quantities.length, diagram.state);
    const py = placeIn(diagram.picture.boxes.dots, diagram.picture.ranges.dots);
    let best = null;
    let least = Infinity;
    for (let k = from; k < from + samples; k++) {
      if (Number.isNaN(data[k])) continue;
      const away = this.pointer ? Math.abs(py(data[k]) - this.pointer[1]) : 0;
      if (away <= least) {
        least = away;
        best = data[k];
      }
    }
    return best;
  }

  // The line of the present place, the open motion, and the sample that is told.
  draw(span, height, style, ratio) {
    const { diagram } = this;
    const pen = byId("diagram-over").getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, span.pixels, height);
    const upright = (share, color, dash) => {
      const x = Math.round((share - span.from) / span.size * span.pixels) + 0.5;
      pen.setLineDash(dash);
      pen.strokeStyle = color;
      pen.beginPath();
      pen.moveTo(x, 0);
      pen.lineTo(x, height);
      pen.stroke();
    };
    pen.lineWidth = 1.5;
    const open = diagram.app.motionCell();
    if (open) upright(shareAlong(diagram.line, open), pinColor(0), []);
    pen.lineWidth = 1;
    const onMap = this.pointer ? null : diagram.app.pointer();
    if (onMap) upright(onMap[diagram.line.axis], style.faint, [3, 3]);
    const column = this.column();
    const share = this.share();
    if (share !== null) upright(column ? column.share : share, style.accent, []);
    const sample = column ? this.sample(column) : null;
    diagram.side.tell(column, sample);
    if (sample === null) return;
    const { boxes, ranges } = diagram.picture;
    pen.setLineDash([]);
    pen.lineWidth = 2;
    pen.beginPath();
    pen.arc(diagram.picture.px(column.share), placeIn(boxes.dots, ranges.dots)(sample), 4.5, 0, 7);
    pen.stroke();
  }

  open() {
    const { diagram } = this;
    const column = this.column();
    const share = this.share();
    if (share === null || share < 0 || share > 1) return;
    diagram.app.onOpen(mapCell(diagram.line, column ? cellOf(column) : this.finestCell(share)));
  }

  walk(step) {
    const { diagram } = this;
    const { from, size, pixels } = diagram.span();
    const middle = from + size / 2;
    const motion = diagram.app.motionCell();
    const open = motion ? shareAlong(diagram.line, motion) : middle;
    const start = open < from || open > from + size ? middle : open;
    const before = this.share();
    this.pointer = null;
    const cell = this.finestCell(before === null ? start : before);
    if (before !== null) cell.k = Math.min(2 ** cell.depth - 1, Math.max(0, cell.k + step));
    this.cursor = cell;
    const away = (this.share() - middle) / size;
    if (Math.abs(away) > 0.5) this.pan(-away * pixels);
    diagram.app.onAnnounce();
    diagram.app.onFrame();
  }

  // Along the diagram's axis alone.
  pan(dx) {
    const { along, app } = this.diagram;
    if (along === 0) app.view.pan(dx, 0);
    else app.view.pan(0, -dx / app.view.width * app.view.height);
    app.onMoved();
  }

  zoom(px, factor) {
    const { along, app } = this.diagram;
    const { view } = app;
    const before = view.copy();
    if (along === 0) view.zoom(px, view.height / 2, factor, 1);
    else view.zoom(view.width / 2, view.height * (1 - px / view.width), 1, factor);
    // The other axis stays as it is, to the last bit.
    view.set(along === 0 ? { ...before, x0: view.x0, sx: view.sx } : { ...before, y0: view.y0, sy: view.sy });
    app.onMoved();
  }

  acts() {
    const { app } = this.diagram;
    const pixel = () => {
      const { from, size, pixels } = this.diagram.span();
      const share = this.share();
      return share === null ? pixels / 2 : (share - from) / size * pixels;
    };
    return {
      pan: (dx) => this.pan(dx),
      zoom: (px, py, fx, fy) => this.zoom(px, fx === 1 ? fy : fx),
      hover: (px, py) => {
        this.pointer = px === null ? null : [px, py];
        if (this.pointer) this.cursor = null;
        app.onFrame();
      },
      click: (px, py) => {
        this.pointer = [px, py];
        this.open();
      },
      waiting: () => {},
      walk: (dx) => { if (dx !== 0) this.walk(dx); },
      open: () => this.open(),
      zoomKey: (factor) => this.zoom(pixel(), factor),
      panKey: (dx) => this.pan(-dx * this.diagram.span().pixels / 8),
      home: () => app.onHome(),
      leave: () => {
        this.leave();
        app.onFrame();
      },
    };
  }
}
