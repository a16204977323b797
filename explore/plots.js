// A small plot on a canvas: lines and dots, axes with ticks, and the numbers nearest to the pointer.

import { linearTicks, logTicks, short } from "./ticks.js";
import { themeStyle } from "./theme.js";

const room = { left: 62, right: 8, top: 6, bottom: 34 };

export class Plot {
  // about: label, height, equal (both axes at one scale), logY, circle (the unit circle), sticks
  constructor(parent, about) {
    this.about = about;
    this.series = [];
    this.bands = [];
    this.canvas = document.createElement("canvas");
    this.canvas.className = "plot";
    this.canvas.setAttribute("role", "img");
    this.text = document.createElement("div");
    this.text.className = "plottext";
    parent.append(this.canvas, this.text);
    this.canvas.addEventListener("pointermove", (event) => this.hover(event));
    this.canvas.addEventListener("pointerleave", () => {
      this.text.textContent = "";
      this.draw();
    });
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  // series: [{ x, y, color, dots, name }], bands: [{ from, to, color }] that shade the ground
  set(series, xTitle, yTitle, bands = []) {
    this.series = series;
    this.bands = bands;
    this.xTitle = xTitle;
    this.yTitle = yTitle;
    this.canvas.setAttribute("aria-label", this.about.label + ": " + yTitle + " over " + xTitle + ". " +
      series.map((one) => one.name).filter((name, k, all) => all.indexOf(name) === k).join(", "));
    this.text.textContent = "";
    this.draw();
  }

  range(field, log) {
    let low = Infinity;
    let high = -Infinity;
    for (const one of this.series) {
      for (const value of one[field]) {
        if (!Number.isFinite(value) || log && value <= 0) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (this.about.circle) {
      low = Math.min(low, -1.1);
      high = Math.max(high, 1.1);
    }
    if (low > high) return log ? [0.1, 1] : [0, 1];
    // Twelve decades show what there is to see; below is rounding.
    if (log) return [Math.max(low, high * 1e-12) * 0.8, high * 1.25];
    const edge = (high - low) * 0.04 || Math.abs(high) * 0.05 || 1;
    return field === "x" && !this.about.equal && !this.about.loose ? [low, high > low ? high : low + edge]
      : [low - edge, high + edge];
  }

  scales(width, height) {
    let [x0, x1] = this.range("x", false);
    let [y0, y1] = this.range("y", this.about.logY);
    if (this.about.equal) {
      const pixel = Math.max((x1 - x0) / width, (y1 - y0) / height);
      [x0, x1] = [(x0 + x1 - pixel * width) / 2, (x0 + x1 + pixel * width) / 2];
      [y0, y1] = [(y0 + y1 - pixel * height) / 2, (y0 + y1 + pixel * height) / 2];
    }
    const log = this.about.logY;
    const bottom = log ? Math.log(y0) : y0;
    const tall = (log ? Math.log(y1) : y1) - bottom;
    return {
      x0, x1, y0, y1,
      px: (x) => room.left + (x - x0) / (x1 - x0) * width,
      py: (y) => room.top + height - ((log ? Math.log(Math.max(y, y0)) : y) - bottom) / tall * height,
    };
  }

  draw() {
    const box = { width: this.canvas.clientWidth, height: this.about.height };
    if (box.width < 80) return;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    this.canvas.style.height = box.height + "px";
    this.canvas.width = Math.round(box.width * ratio);
    this.canvas.height = Math.round(box.height * ratio);
    const pen = this.canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const width = box.width - room.left - room.right;
    const height = box.height - room.top - room.bottom;
    this.scale = this.scales(width, height);
    this.frame(pen, width, height);
    pen.save();
    pen.beginPath();
    pen.rect(room.left, room.top, width, height);
    pen.clip();
    for (const band of this.bands) {
      const left = this.scale.px(band.from);
      pen.fillStyle = band.color;
      pen.fillRect(left, room.top, this.scale.px(band.to) - left, height);
    }
    if (this.about.circle) this.unitCircle(pen);
    for (const one of this.series) this.line(pen, one);
    pen.restore();
  }

  frame(pen, width, height) {
    const style = themeStyle();
    const s = this.scale;
    pen.font = style.small;
    pen.fillStyle = style.text;
    pen.lineWidth = 1;
    const xt = linearTicks(s.x0, s.x1, Math.max(2, width / 70));
    const yt = (this.about.logY ? logTicks : linearTicks)(s.y0, s.y1, Math.max(2, height / 32));
    pen.strokeStyle = style.line;
    pen.beginPath();
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const tick of xt.ticks) {
      const x = Math.round(s.px(xt.base + tick.offset)) + 0.5;
      pen.moveTo(x, room.top);
      pen.lineTo(x, room.top + height);
      pen.fillText(tick.label, x, room.top + height + 4);
    }
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const tick of yt.ticks) {
      const y = Math.round(s.py(yt.base + tick.offset)) + 0.5;
      pen.moveTo(room.left, y);
      pen.lineTo(room.left + width, y);
      pen.fillText(tick.label, room.left - 4, y, room.left - 18);
    }
    pen.stroke();
    pen.strokeStyle = style.faint;
    pen.strokeRect(room.left + 0.5, room.top + 0.5, width, height);
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    const from = (title, ticks) => (ticks.from === "" ? title : title + ", counted from " + ticks.from);
    pen.fillText(from(this.xTitle || "", xt), room.left + width / 2, room.top + height + 29, width);
    pen.save();
    pen.translate(10, room.top + height / 2);
    pen.rotate(-Math.PI / 2);
    pen.fillText(from(this.yTitle || "", yt), 0, 0, height);
    pen.restore();
  }

  unitCircle(pen) {
    const s = this.scale;
    pen.strokeStyle = themeStyle().text;
    pen.lineWidth = 1;
    pen.beginPath();
    pen.arc(s.px(0), s.py(0), s.px(1) - s.px(0), 0, 7);
    pen.stroke();
  }

  line(pen, one) {
    const s = this.scale;
    pen.strokeStyle = one.color;
    pen.fillStyle = one.color;
    pen.lineWidth = 1.4;
    if (one.dots) {
      for (let k = 0; k < one.x.length; k++) {
        pen.beginPath();
        pen.arc(s.px(one.x[k]), s.py(one.y[k]), one.dots, 0, 7);
        pen.fill();
        pen.strokeStyle = themeStyle().back;
        pen.lineWidth = 0.8;
        pen.stroke();
      }
      return;
    }
    pen.beginPath();
    let open = false;
    for (let k = 0; k < one.x.length; k++) {
      if (!Number.isFinite(one.y[k]) || !Number.isFinite(one.x[k])) {
        open = false;
        continue;
      }
      if (open) pen.lineTo(s.px(one.x[k]), s.py(one.y[k]));
      else pen.moveTo(s.px(one.x[k]), s.py(one.y[k]));
      open = true;
    }
    pen.stroke();
  }

  // The nearest point in pixels gets a ring, and its numbers stand below the plot.
  hover(event) {
    if (!this.scale) return;
    const box = this.canvas.getBoundingClientRect();
    const px = event.clientX - box.left;
    const py = event.clientY - box.top;
    let best = null;
    let least = Infinity;
    for (const one of this.series) {
      for (let k = 0; k < one.x.length; k++) {
        const away = Math.hypot(this.scale.px(one.x[k]) - px, this.scale.py(one.y[k]) - py);
        if (away < least) {
          least = away;
          best = { one, k };
        }
      }
    }
    if (!best) return;
    const { one, k } = best;
    this.draw();
    const pen = this.canvas.getContext("2d");
    pen.strokeStyle = themeStyle().text;
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.arc(this.scale.px(one.x[k]), this.scale.py(one.y[k]), 4.5, 0, 7);
    pen.stroke();
    this.text.textContent = this.xTitle + " = " + short(one.x[k]) + ", " +
      this.yTitle + " = " + short(one.y[k]) + (this.series.length > 1 ? " (" + one.name + ")" : "");
  }
}
