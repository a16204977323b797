// Starts the page and ties its parts together: the scene, the view, the colours and the frames.

import { Axis, drawAxes } from "./axes.js";
import { ColorState } from "./colorstate.js";
import { Contours } from "./contours.js";
import { Controls } from "./controls.js";
import { Curves } from "./curves.js";
import { setUpExports } from "./exports.js";
import { Layers } from "./layers.js";
import { drawLegend } from "./legend.js";
import { Diagram } from "./diagram.js";
import { decode, drawnText, encode, History } from "./link.js";
import { Loader } from "./loader.js";
import { MotionPanel } from "./motion.js";
import { drawMarks, marksOf, Painter } from "./paint.js";
import { setUpPointer } from "./pointer.js";
import { Previewer } from "./preview.js";
import { pointAt, Readout } from "./readout.js";
import { SceneKeeper } from "./scene.js";
import { watchStage } from "./stage.js";
import { Sliders } from "./sliders.js";
import { countsText, Statistics } from "./statistics.js";
import { comesFirst, statusLine, tellTrouble } from "./status.js";
import { Strip } from "./strip.js";
import { setUpTheme, themeStyle } from "./theme.js";
import { neededTiles, TileCache } from "./tiles.js";
import { setUpUnits } from "./units.js";
import { cellShares, View } from "./view.js";
import { Walker } from "./walker.js";

const byId = (id) => document.getElementById(id);
const mapCanvas = byId("map");
const tell = (kind, text) => tellTrouble(byId("banner"), kind, text);

const view = new View();
const cache = new TileCache(256e6);
const layers = new Layers();
const painter = new Painter(mapCanvas, cache, layers, (wait) => setTimeout(requestFrame, wait));
const colors = new ColorState(cache, layers, view, painter);
const statistics = new Statistics(requestFrame);
const contours = new Contours(byId("lines"), requestFrame);
const curves = new Curves(byId("curves-map"), byId("curves"), {
  onFrame: requestFrame, onState: stateChanged,
});
const readout = new Readout(byId("readout"), byId("live"));
const walker = new Walker(view);

let scene = null;
let axes = null;
let frame = 0;
let pointer = null;
let clickPending = false;
let speed = 0;
let refusedTimer = 0;
let rangesTimer = 0;
let tickLabels = { x: [], y: [] };

const loader = new Loader("tiles", 0, 512, {
  wanted() {
    if (!scene || view.width <= 1) return null;
    const focus = pointer ? view.toShare(...pointer) : [view.x0 + view.sx / 2, view.y0 + view.sy / 2];
    const { key } = scene;
    return { name: key, places: neededTiles(cache, key, view, speed, focus),
      request: (tiles) => ({ scene: key, tiles }) };
  },
  wait: () => previewer.ahead() || keeper.dragging,
  onRecord(head, numbers, wanted) {
    if (head[5] > 0) speed = head[5];
    cache.put(wanted.name, head[1], head[2], head[3], numbers);
    statistics.forget();
    requestFrame();
  },
  onChange() {
    keeper.pump();
    requestFrame();
  },
  onTrouble(text) { tell("tiles", text); },
  onUnknownScene() { keeper.load(0); },
});
const previewer = new Previewer({
  page: loader.page, view, cache, layers,
  scene: () => scene,
  // So few points at once are slower than tiles.
  onSpeed(value) { speed = Math.max(speed, value); },
  onPicture() { statistics.forget(); },
  onDone() {
    loader.refresh();
    requestFrame();
  },
});
const keeper = new SceneKeeper({
  onScene: takeScene, onTrouble(text) { tell("scene", text); }, onRefused: tellRefused,
  onChange: requestFrame,
  ready: () => !previewer.busy && loader.timer === 0,
  onRest() {
    if (scene) motion.setScene(scene);
    loader.refresh();
  },
});
const sliders = new Sliders(byId("sliders"), byId("filter"), keeper);
const motion = new MotionPanel(byId("motion"), { onChange: requestFrame, onClose: stateChanged });
const diagram = new Diagram({
  view, scene: () => scene, axes: () => axes, quantity: () => colors.quantityIndex(scene),
  motionCell: () => motion.cell, walkerCell: () => walker.cell,
  pointer: () => (pointer ? view.toShare(...pointer) : null),
  onFrame: requestFrame, onMoved: viewChanged, onState: stateChanged, onHome: goHome,
  onOpen(cell) { motion.open(scene, cell); past.changed(); },
  onAnnounce() { readout.announce(); },
  onUnknownScene() { keeper.load(0); },
  onTrouble(text) { tell("diagram", text); },
});
const strip = new Strip(byId("strip"), (hash) => {
  const whole = hash + diagram.linkText() + drawnText(drawn());
  history.pushState(null, "", whole);
  goTo(whole);
});
const hashNow = () => encode(keeper, view, colors.look, motion.cell, diagram.link(), drawn());
const past = new History(hashNow, () => {
  if (!painter.old && !keeper.busy && painter.hasPicture(view, scene.key)) strip.add(mapCanvas, past.hash());
});
const controls = new Controls(colors, {
  scene: () => scene,
  onLook: stateChanged,
  onHome: goHome,
  onAxes(x, y) { keeper.setAxes(x, y, openPlace()); },
  onReset() { keeper.reset(); },
  contours: () => contours.name,
  onContours(name) {
    contours.choose(name);
    colors.legendOld = true;
    stateChanged();
  },
});
const units = setUpUnits(byId("units"), () => {
  controls.showLook();
  colors.legendOld = true;
  stateChanged();
});
const drawn = () => ({ contours: contours.name, si: units.si, curves: curves.shown });

// The values of the axes at the open motion, or at the crosshair: other axes begin there.
function openPlace() {
  const cell = motion.cell || walker.cell;
  return cell && scene ? cellShares(cell).map((share, n) => [axes[n].name, axes[n].value(share)]) : [];
}

// A new scene from the server. The old pixels stay until its first tiles come.
function takeScene(next, wantedView) {
  const sameWorld = scene !== null && [0, 1].every((n) => ["name", "low", "high", "log"].every((field) =>
    scene.axes[n][field] === next.axes[n][field]));
  if (scene !== null && scene.key !== next.key) painter.keep(view, sameWorld);
  if (scene !== null) tell("refused", null);
  scene = next;
  axes = next.axes.map((told) => new Axis(told));
  view.maxDepth = next.max_depth;
  if (next.points_per_second > 0) speed = next.points_per_second;
  if (wantedView) view.set(wantedView);
  else if (!sameWorld) firstView();
  if (!sameWorld) {
    walker.cell = null;
    colors.fit();
    contours.choose(contours.name);
  }
  if (!next.quantities.some((quantity) => quantity.name === colors.look.quantity)) {
    colors.look.quantity = next.quantities[0].name;
    colors.forget(next);
  }
  if (!next.quantities.some((quantity) => quantity.name === contours.name)) contours.choose("");
  controls.showScene(next);
  units.show(next);
  sliders.show(next);
  askForRanges(next);
  curves.setScene(next, axes);
  colors.renew(next);
  if (!keeper.dragging) motion.setScene(next);
  viewChanged();
}

// How far states go is found beside the first tiles: later the same scene tells it.
function askForRanges(next) {
  clearTimeout(rangesTimer);
  if (next.choices.every((choice) => choice.low !== null)) return;
  rangesTimer = setTimeout(() => {
    if (!keeper.busy) keeper.load(0);
    else askForRanges(scene);
  }, 4000);
}

// The scene stays, and the choices show again what it has. Without one, the link itself was refused.
function tellRefused(text) {
  tell("refused", text);
  clearTimeout(refusedTimer);
  refusedTimer = setTimeout(() => tell("refused", null), 8000);
  if (!scene) {
    if (location.hash === "") return;
    history.replaceState(null, "", location.pathname);
    goTo("");
    return;
  }
  controls.showScene(scene);
  sliders.show(scene);
  stateChanged();
}

function firstView() {
  const [x, y] = axes;
  const x0 = x.share(x.from);
  const y0 = y.share(y.from);
  view.set({ x0, y0, sx: x.share(x.to) - x0, sy: y.share(y.to) - y0 });
}

function goHome() {
  if (!scene) return;
  firstView();
  viewChanged();
}

function viewChanged() {
  colors.viewMoved();
  loader.refresh();
  diagram.refresh();
  stateChanged();
}

function stateChanged() {
  past.changed();
  requestFrame();
}

function requestFrame() {
  if (!frame) frame = requestAnimationFrame(draw);
}

function draw() {
  frame = 0;
  if (!scene) return;
  const style = themeStyle();
  colors.follow(scene, loader.busy);
  const k = colors.quantityIndex(scene);
  if (painter.draw(view, scene.key, k, colors.map, style)) requestFrame();
  tickLabels = drawAxes(byId("xticks"), byId("yticks"), axes, view, style, painter.ratio);
  contours.follow(cache, layers, scene, view, painter.ratio);
  curves.draw(view, painter.ratio);
  if (statistics.follow(cache, layers, scene, view, k)) colors.legendOld = true;
  if (colors.legendOld) {
    drawLegend(byId("legend"), legendFacts(), view.height, style, painter.ratio);
    colors.legendOld = false;
  }
  drawMarks(byId("marks"), view, marksOf(motion, walker, scene), painter.ratio);
  diagram.draw(style, painter.ratio);
  diagram.mark(byId("marks"), painter.ratio);
  const at = readoutPlace();
  const point = diagram.point() || (at ? pointAt(cache, layers, scene, axes, view, at[0], at[1]) : null);
  const near = pointer && curves.at(view, ...pointer);
  mapCanvas.style.cursor = near ? "pointer" : "";
  readout.show(point, scene, axes, colors.look.quantity, near ? near.name : "");
  const line = statusLine(axes, view, loader.left, speed, comesFirst(keeper, previewer),
    countsText(statistics.counts));
  if (byId("status").textContent !== line) byId("status").textContent = line;
  if (settled()) past.quiet();
}

function legendFacts() {
  const { counts } = statistics;
  return { quantity: scene.quantities[colors.quantityIndex(scene)], map: colors.map,
    error: counts ? counts.error : null, contours: contours.title(scene) };
}

function readoutPlace() {
  if (!pointer) return walker.cell ? cellShares(walker.cell) : null;
  const at = view.toShare(...pointer);
  return view.inWorld(...at) ? at : null;
}

function settled() {
  return scene !== null && !loader.busy && !keeper.busy && !motion.busy && !diagram.busy && !clickPending &&
    !frame && !previewer.busy && !statistics.old && !contours.timer && !curves.busy &&
    loader.left === 0 && !colors.fitting && neededTiles(cache, scene.key, view, speed, [0, 0]).length === 0;
}

function clickAt(px, py, pointerType) {
  if (!scene) return;
  const at = view.toShare(px, py);
  if (!view.inWorld(...at)) return;
  const point = pointAt(cache, layers, scene, axes, view, at[0], at[1]);
  const border = curves.at(view, px, py, pointerType);
  if (border) motion.open(scene, border);
  else motion.open(scene, point && point.cell ? point.cell : view.cellAt(view.targetDepth(), at[0], at[1]));
  past.changed();
}

setUpPointer(mapCanvas, {
  pan(dx, dy) { view.pan(dx, dy); viewChanged(); },
  zoom(px, py, fx, fy) { view.zoom(px, py, fx, fy); viewChanged(); },
  hover(px, py) { pointer = px === null ? null : [px, py]; requestFrame(); },
  click: clickAt,
  waiting(on) { clickPending = on; requestFrame(); },
  walk(dx, dy) {
    pointer = null;
    if (scene && walker.step(dx, dy)) viewChanged();
    readout.announce();
    requestFrame();
  },
  open() {
    if (pointer && !walker.cell) clickAt(...pointer);
    else if (walker.cell) clickAt(...walker.pixel());
    else this.walk(0, 0);
  },
  zoomKey(factor) {
    const at = pointer && !walker.cell ? pointer : walker.pixel();
    view.zoom(at[0], at[1], factor, factor);
    viewChanged();
  },
  panKey(dx, dy) { view.pan(-dx * view.width / 8, dy * view.height / 8); viewChanged(); },
  home: goHome,
  leave() {
    if (!walker.cell) motion.close(true);
    walker.cell = null;
    requestFrame();
  },
});

// Takes the state from a link. The scene is asked for only when it is another one.
function goTo(hash) {
  const wanted = decode(hash);
  const before = colors.look.quantity;
  const has = (name) => scene.quantities.some((one) => one.name === name);
  if (scene && wanted.look.quantity && !has(wanted.look.quantity)) delete wanted.look.quantity;
  Object.assign(colors.look, wanted.look);
  if (contours.name !== wanted.drawn.contours) contours.choose(wanted.drawn.contours);
  units.choose(wanted.drawn.si);
  curves.choose(wanted.drawn.curves);
  colors.legendOld = true;
  controls.showLook();
  past.arrived();
  strip.mark(hash);
  const done = () => {
    diagram.restore(wanted.pane);
    if (wanted.cell) motion.open(scene, wanted.cell);
    else motion.close(false);
  };
  if (scene && keeper.sameAs(wanted.changes)) {
    keeper.cancel();
    if (wanted.view) view.set(wanted.view);
    else firstView();
    if (before !== colors.look.quantity) colors.forget(scene);
    colors.renew(scene);
    loader.refresh();
    done();
    requestFrame();
  } else {
    if (before !== colors.look.quantity) colors.forget(null);
    keeper.replace(wanted.changes, wanted.view, done);
  }
}

window.addEventListener("popstate", () => goTo(location.hash));

// There are many sliders before the map for those who go by keys.
byId("skip").addEventListener("click", () => mapCanvas.focus());

setUpTheme(byId("theme"), () => {
  colors.legendOld = true;
  motion.redraw();
  requestFrame();
});

setUpExports({
  view, cache, painter, tell,
  get scene() { return scene; },
  get axes() { return axes; },
  get contours() { return contours.made && contours.made.groups; },
  get curves() { return curves.inView(view); },
  legend: legendFacts,
}, motion);

watchStage(view, painter, () => {
  if (scene) view.clamp();
  colors.legendOld = true;
  loader.refresh();
  requestFrame();
});

// For tests of the page.
window.gearsweepExplorer = {
  view: () => ({ ...view.copy(), width: view.width, height: view.height, depth: view.targetDepth(),
    scene: scene && scene.key, quantity: colors.look.quantity, ticks: tickLabels, left: loader.left }),
  settled,
  valueAt: (px, py) => scene && pointAt(cache, layers, scene, axes, view, ...view.toShare(px, py)),
  click: clickAt,
  diagram: () => diagram.told(),
  curves: () => curves.points(view),
  frameMilliseconds: () => painter.lastMilliseconds,
};

goTo(location.hash);
