// Draws contour lines and their labels, on a canvas or into SVG.

// In the middle of its longest line that is inside the view and away from other labels.
function placeLabel(view, lines, taken) {
  const sorted = [...lines].sort((a, b) => b.length - a.length).slice(0, 12);
  for (const line of sorted) {
    for (const part of [0.5, 0.3, 0.7, 0.15, 0.85]) {
      const k = 2 * Math.floor(line.length / 2 * part);
      const x = view.toPixelX(line[k]);
      const y = view.toPixelY(line[k + 1]);
      if (x < 30 || y < 14 || x > view.width - 30 || y > view.height - 14) continue;
      if (taken.some((one) => Math.abs(one.x - x) < 60 && Math.abs(one.y - y) < 22)) continue;
      taken.push({ x, y });
      return { x, y };
    }
  }
  return null;
}

// Two strokes, so that a line shows on every colour.
export function paintContours(pen, view, groups) {
  const places = [];
  const strokes = [["rgba(0,0,0,0.7)", 2.8], ["rgb(255,255,255)", 1.1]];
  pen.lineJoin = "round";
  for (const [color, width] of strokes) {
    pen.strokeStyle = color;
    pen.lineWidth = width;
    pen.beginPath();
    for (const { lines } of groups) {
      for (const line of lines) {
        pen.moveTo(view.toPixelX(line[0]), view.toPixelY(line[1]));
        for (let k = 2; k < line.length; k += 2) {
          pen.lineTo(view.toPixelX(line[k]), view.toPixelY(line[k + 1]));
        }
      }
    }
    pen.stroke();
  }
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (const { label, lines } of groups) {
    const place = label && placeLabel(view, lines, places);
    if (!place) continue;
    const half = pen.measureText(label).width / 2 + 3;
    pen.fillStyle = "rgba(0,0,0,0.72)";
    pen.fillRect(place.x - half, place.y - 8, 2 * half, 16);
    pen.fillStyle = "rgb(255,255,255)";
    pen.fillText(label, place.x, place.y);
  }
}
