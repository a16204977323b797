// Puts the parts of a diagram on their canvases.

import { drawXTicks, yWidth } from "./axes.js";
import { drawLeft, layout, sampleRange, valueRange } from "./diagramframe.js";
import { drawPlot } from "./diagramplot.js";
import { shownIn } from "./units.js";

const byId = (id) => document.getElementById(id);
const lineColors = ["#2f86d6", "#d9770b", "#109b78", "#c25fa8", "#8a63d2"];

export class DiagramPicture {
  constructor() {
    this.boxes = layout(200);
    this.ranges = { dots: [0, 1], lines: [0, 1] };
    this.px = () => 0;
    this.milliseconds = 0;
  }

  // Exponents tell what the dots are; without any, the quantity that the map shows.
  lines(scene, shown) {
    const all = scene.quantities.map((quantity, index) => ({ quantity, index }));
    const exponents = all.filter(({ quantity }) => quantity.is_exponent);
    return (exponents.length > 0 ? exponents : [all[shown]]).map(({ quantity, index }, k) => ({
      index, quantity, classes: quantity.classes, isExponent: quantity.is_exponent,
      color: lineColors[k % lineColors.length],
      error: quantity.error ? scene.quantities.findIndex((one) => one.name === quantity.error) : -1,
    }));
  }

  // told: the state. layers: see drawPlot().
  draw({ axis, axisTicks, span, height, ratio, style, lines, layers, state, told }) {
    const width = span.pixels;
    const [first] = layers;
    const last = layers[layers.length - 1];
    // The line before gives the range until there is something of this one.
    const ruling = last.columns.length >= 4 ? last : first;
    this.boxes = layout(height);
    this.ranges = { dots: sampleRange(ruling.columns, ruling.quantities, state),
      lines: valueRange(ruling.columns, lines) };
    this.px = (share) => (share - span.from) / span.size * width;
    const canvas = byId("diagram-plot");
    for (const each of [canvas, byId("diagram-over")]) {
      each.width = Math.round(width * ratio);
      each.height = Math.round(height * ratio);
      each.style.width = width + "px";
      each.style.height = height + "px";
    }
    const ticks = axis.ticks(span.from, span.size, Math.max(2, width / 90)).places;
    this.milliseconds = drawPlot(canvas, { width, height, ratio, layers, lines, state, boxes: this.boxes,
      ranges: this.ranges, px: this.px, grid: ticks.map((tick) => tick.at * width),
      world: [this.px(0), this.px(1)] }, style);
    const { dots, lines: low } = this.boxes;
    const { factor, title } = shownIn(told);
    drawLeft(byId("diagram-left"), yWidth, height, [
      { box: dots, range: this.ranges.dots, factor, title },
      { box: low, range: this.ranges.lines, factor: shownIn(lines[0].quantity).factor,
        classes: lines[0].classes },
    ], style, ratio);
    const own = byId("diagram-axis");
    own.hidden = !axisTicks;
    if (axisTicks) drawXTicks(own, axis, { x0: span.from, sx: span.size, width }, style, ratio);
    canvas.setAttribute("aria-label", "Bifurcation diagram: " + title + " over " + axis.title +
      ". Left and right arrow keys walk, Enter opens the motion, plus and minus zoom.");
  }
}
