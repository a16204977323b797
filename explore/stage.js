// The canvases of the map and beside it, which are as large as the page leaves them.

const byId = (id) => document.getElementById(id);

const overMap = ["lines", "curves-map", "marks"];

// onSize(): the view and the painter have another size.
export function watchStage(view, painter, onSize) {
  new ResizeObserver(() => {
    const width = byId("mapbox").clientWidth;
    const height = byId("mapbox").clientHeight;
    if (width < 2 || height < 2) return;
    view.width = width;
    view.height = height;
    painter.resize(width, height);
    for (const id of overMap) {
      byId(id).width = painter.canvas.width;
      byId(id).height = painter.canvas.height;
    }
    for (const id of ["map", ...overMap, "xticks"]) byId(id).style.width = width + "px";
    for (const id of ["map", ...overMap, "yticks", "legend"]) byId(id).style.height = height + "px";
    onSize();
  }).observe(byId("mapbox"));
}
