// Writes SVG with those methods of a canvas context that the axes, the legend, the contours and the curves use.

const escapes = { "&": "&amp;", "<": "&lt;", ">": "&gt;", "\"": "&quot;" };
const escaped = (text) => String(text).replace(/[&<>"]/g, (letter) => escapes[letter])
  // XML has no other control characters.
  .replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f]/g, "");
const places = (value) => String(Number(value.toFixed(2)));

export class SvgPen {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.out = [];
    this.definitions = [];
    this.stack = [];
    this.path = "";
    this.state = { groups: 0 };
    this.fillStyle = this.strokeStyle = "black";
    this.lineWidth = 1;
    this.lineJoin = "miter";
    this.dashes = [];
    this.lineDashOffset = 0;
    this.font = "10px sans-serif";
    this.textAlign = "left";
    this.textBaseline = "alphabetic";
    // Only a canvas knows how wide a text is.
    this.ruler = document.createElement("canvas").getContext("2d");
  }

  measureText(text) {
    this.ruler.font = this.font;
    return this.ruler.measureText(text);
  }

  save() {
    const { fillStyle, strokeStyle, lineWidth, lineJoin, font, textAlign, textBaseline } = this;
    this.stack.push({ groups: this.state.groups,
      pen: { fillStyle, strokeStyle, lineWidth, lineJoin, font, textAlign, textBaseline } });
    this.state = { groups: 0 };
  }

  restore() {
    this.out.push("</g>".repeat(this.state.groups));
    const { groups, pen } = this.stack.pop();
    this.state = { groups };
    Object.assign(this, pen);
  }

  group(attributes) {
    this.out.push("<g " + attributes + ">");
    this.state.groups++;
  }

  translate(x, y) { this.group(`transform="translate(${places(x)} ${places(y)})"`); }
  rotate(angle) { this.group(`transform="rotate(${places(angle * 180 / Math.PI)})"`); }

  setLineDash(lengths) { this.dashes = lengths; }

  beginPath() { this.path = ""; }
  moveTo(x, y) { this.path += "M" + places(x) + " " + places(y); }
  lineTo(x, y) { this.path += "L" + places(x) + " " + places(y); }

  rect(x, y, width, height) {
    this.path += `M${places(x)} ${places(y)}h${places(width)}v${places(height)}h${places(-width)}z`;
  }

  clip() {
    const name = "clip" + this.definitions.length;
    this.definitions.push(`<clipPath id="${name}"><path d="${this.path}"/></clipPath>`);
    this.group(`clip-path="url(#${name})"`);
  }

  stroke() {
    if (this.path === "") return;
    this.out.push(`<path d="${this.path}" fill="none" stroke="${escaped(this.strokeStyle)}" ` +
      `stroke-width="${this.lineWidth}" stroke-linejoin="${this.lineJoin}"${this.dashText()}/>`);
  }

  dashText() {
    if (this.dashes.length === 0) return "";
    return ` stroke-dasharray="${this.dashes.map(places).join(" ")}" ` +
      `stroke-dashoffset="${places(this.lineDashOffset)}"`;
  }

  box(x, y, width, height, attributes) {
    this.out.push(`<rect x="${places(x)}" y="${places(y)}" width="${places(width)}" ` +
      `height="${places(height)}" ${attributes}/>`);
  }

  fillRect(x, y, width, height) { this.box(x, y, width, height, `fill="${escaped(this.fillStyle)}"`); }

  strokeRect(x, y, width, height) {
    this.box(x, y, width, height,
      `fill="none" stroke="${escaped(this.strokeStyle)}" stroke-width="${this.lineWidth}"`);
  }

  // Not all programs know the baselines of SVG, so the text is placed by its own height.
  fillText(text, x, y, most) {
    const size = this.measureText(text);
    const up = size.fontBoundingBoxAscent;
    const down = size.fontBoundingBoxDescent;
    const lower = { top: up, middle: (up - down) / 2, alphabetic: 0, bottom: -down }[this.textBaseline];
    const anchor = { left: "start", center: "middle", right: "end" }[this.textAlign];
    const narrow = most > 0 && size.width > most
      ? ` textLength="${places(most)}" lengthAdjust="spacingAndGlyphs"` : "";
    this.out.push(`<text x="${places(x)}" y="${places(y + lower)}" text-anchor="${anchor}"${narrow} ` +
      `style="font:${escaped(this.font)}" fill="${escaped(this.fillStyle)}">${escaped(text)}</text>`);
  }

  createPattern(canvas) {
    const name = "pattern" + this.definitions.length;
    const { width, height } = canvas;
    this.definitions.push(`<pattern id="${name}" width="${width}" height="${height}" ` +
      `patternUnits="userSpaceOnUse"><image width="${width}" height="${height}" ` +
      `href="${canvas.toDataURL()}"/></pattern>`);
    return `url(#${name})`;
  }

  drawImage(canvas, x, y, width, height) {
    this.out.push(`<image x="${places(x)}" y="${places(y)}" width="${places(width)}" ` +
      `height="${places(height)}" preserveAspectRatio="none" style="image-rendering:pixelated" ` +
      `href="${canvas.toDataURL()}"/>`);
  }

  text(title) {
    while (this.stack.length > 0) this.restore();
    const { width, height } = this;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" ` +
      `viewBox="0 0 ${width} ${height}">\n<title>${escaped(title)}</title>\n` +
      `<defs>${this.definitions.join("\n")}</defs>\n${this.out.filter(Boolean).join("\n")}\n</svg>\n`;
  }
}
