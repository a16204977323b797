// The map with its axes, legend, contours and curves, on a ground of the theme: as pixels or as SVG.

import { paintX, paintY, xHeight, yWidth } from "./axes.js";
import { paintContours } from "./contourpaint.js";
import { keyHeight, paintCurves, paintKey } from "./curvepaint.js";
import { legendWidth, paintLegend } from "./legend.js";
import { SvgPen } from "./svgpen.js";
import { themeStyle } from "./theme.js";

const edge = 10;

function keyWidth(view) { return yWidth + view.width + legendWidth; }

function sizeOf(app) {
  const { view, curves } = app;
  const key = curves ? keyHeight(curves.told, keyWidth(view)) : 0;
  return [keyWidth(view) + 2 * edge, view.height + xHeight + key + 2 * edge];
}

function paint(pen, app) {
  const { view, painter, axes } = app;
  const style = themeStyle();
  const [width, height] = sizeOf(app);
  const { curves } = app;
  const at = (x, y, act) => {
    pen.save();
    pen.translate(edge + x, edge + y);
    act();
    pen.restore();
  };
  pen.fillStyle = style.back;
  pen.fillRect(0, 0, width, height);
  at(0, 0, () => paintY(pen, axes[1], view, style));
  at(yWidth, view.height, () => paintX(pen, axes[0], view, style));
  at(yWidth + view.width, 0, () => paintLegend(pen, app.legend(), view.height, style));
  at(yWidth, 0, () => {
    pen.imageSmoothingEnabled = false;
    pen.drawImage(painter.canvas, 0, 0, view.width, view.height);
    pen.beginPath();
    pen.rect(0, 0, view.width, view.height);
    pen.clip();
    if (app.contours) paintContours(pen, view, app.contours);
    if (curves) paintCurves(pen, view, curves.told, curves.parts);
  });
  if (curves) at(0, view.height + xHeight, () => paintKey(pen, curves.told, keyWidth(view), style));
}

export function picture(app) {
  const canvas = document.createElement("canvas");
  const ratio = app.painter.ratio;
  const [width, height] = sizeOf(app);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  paint(pen, app);
  return canvas;
}

export function pictureSvg(app) {
  const pen = new SvgPen(...sizeOf(app));
  paint(pen, app);
  const [x, y] = app.axes;
  return pen.text(app.legend().quantity.name + " over " + x.name + " and " + y.name);
}
