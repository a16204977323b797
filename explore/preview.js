// What comes before the tiles: the numbers of the result file, or a quick coarse picture of the view.

import { fileGrid, previewGrid } from "./grid.js";
import { getRecords, readRecords, ServerError } from "./server.js";
import { eachPlace } from "./tiles.js";

// A view with this share of its tiles has something to look at.
const enoughTiles = 0.4;
const enoughCoverage = 0.6;

function hasTiles(cache, scene, view) {
  const coarsest = view.coarsestDepth();
  for (let depth = view.targetDepth(); depth >= 0; depth--) {
    let present = 0;
    let all = 0;
    eachPlace(view, depth, (i, j) => {
      all++;
      if (cache.has(scene, depth, i, j)) present++;
    });
    if (present >= (depth <= coarsest ? 1 : enoughTiles * all)) return true;
  }
  return false;
}

// Whether a picture of a view does for another one.
function near(from, to) {
  const overlap = (a0, as, b0, bs) => Math.max(0, Math.min(a0 + as, b0 + bs) - Math.max(a0, b0));
  const shared = overlap(from.x0, from.sx, to.x0, to.sx) * overlap(from.y0, from.sy, to.y0, to.sy);
  return shared > enoughCoverage * to.sx * to.sy && from.sx * from.sy < 9 * to.sx * to.sy;
}

export class Previewer {
  // job: page, view, cache, layers, scene() -> scene or null, onSpeed(points a second), onPicture(),
  // onDone()
  constructor(job) {
    this.job = job;
    this.abort = null;
    this.asked = null;
    this.refused = null;
    this.unable = false;
    this.fileScene = null;
  }

  get busy() { return this.abort !== null || this.fileScene !== null; }

  // Whether the tiles should wait. Asks for the picture that they wait for.
  ahead() {
    const { view } = this.job;
    const scene = this.job.scene();
    if (!scene) return false;
    if (this.fileScene === scene.key) return true;
    const same = (one) => one !== null && one.scene === scene.key && near(one.view, view.copy());
    if (this.abort && same(this.asked)) return true;
    this.stop();
    if (scene.has_data && !this.job.layers.files.has(scene.key)) {
      this.askFile(scene);
      return true;
    }
    if (this.unable || same(this.refused) || this.hasPicture(scene.key)) return false;
    this.askPreview(scene);
    return true;
  }

  hasPicture(scene) {
    const { cache, layers, view } = this.job;
    if (hasTiles(cache, scene, view)) return true;
    return layers.of(scene).some((grid) => grid.coverage(view) > enoughCoverage &&
      grid.pointsIn(view) >= Math.min(400, grid.size / 5));
  }

  stop() {
    if (this.abort) this.abort.abort();
    this.abort = null;
  }

  async askPreview(scene) {
    const { view } = this.job;
    const abort = new AbortController();
    this.abort = abort;
    this.asked = { scene: scene.key, view: view.copy() };
    const inside = (share) => Math.min(1, Math.max(0, share));
    const rectangle = [view.x0, view.y0, view.x1, view.y1].map(inside);
    let grid = null;
    try {
      const request = { scene: scene.key, page: this.job.page, view: rectangle };
      await readRecords("preview", request, abort.signal, (head, numbers) => {
        if (head[0] !== 2) return;
        this.job.onSpeed(head[5]);
        grid = previewGrid(head, numbers, scene.quantities.length);
        if (!grid || this.abort !== abort) return;
        this.job.layers.putPreview(scene.key, grid);
        this.job.onPicture();
      });
    } catch (error) {
      if (error instanceof ServerError && error.status === 404) this.unable = true;
    }
    if (this.abort !== abort) return;
    this.abort = null;
    // What is wrong is told by the tiles, which come next. A view thinner than a cell has no points of the
    // preview, and would have none of another one.
    if (!grid || !this.hasPicture(scene.key)) this.refused = this.asked;
    this.job.onDone();
  }

  async askFile(scene) {
    this.fileScene = scene.key;
    let grid = null;
    try {
      await getRecords("data?" + new URLSearchParams({ scene: scene.key }), (head, numbers) => {
        if (head[0] === 4) grid = fileGrid(head, numbers, scene.quantities.length);
      });
    } catch { /* the tiles tell what is wrong */ }
    this.fileScene = null;
    this.job.layers.putFile(scene.key, grid);
    if (grid) this.job.onPicture();
    this.job.onDone();
  }
}
