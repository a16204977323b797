// What leaves the page: studies, pictures, numbers and commands.

import { commandLine, copyText } from "./copy.js";
import { picture, pictureSvg } from "./picture.js";
import { statusText } from "./readout.js";
import { getBlob, getText, ServerError } from "./server.js";
import { eachPlace, missingAt, tileValue } from "./tiles.js";

const byId = (id) => document.getElementById(id);

function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 30000);
}

function viewQuery(app, more) {
  const { view, scene } = app;
  const inside = (share) => Math.min(1, Math.max(0, share));
  return new URLSearchParams({ scene: scene.key, x0: inside(view.x0), x1: inside(view.x1),
    y0: inside(view.y0), y1: inside(view.y1), ...more });
}

async function saveStudy(app) {
  const text = await getText("study?" + viewQuery(app, { nx: 200, ny: 150 }));
  save(new Blob([text], { type: "text/plain" }), "view.toml");
}

// The points of the deepest depth of which all tiles are there.
async function saveResult(app) {
  const { view, scene, cache } = app;
  let depth = view.targetDepth();
  while (depth > 0 && missingAt(cache, scene.key, view, depth).length > 0) depth--;
  save(await getBlob("result?" + viewQuery(app, { depth })), "view.nc");
}

// What computes the view: from the study itself, or of a model from the study that is saved here.
function runCommand(app) {
  const { view, scene, axes } = app;
  if (!scene.command) return "gearsweep run view.toml -o view.nc";
  const ends = [[view.x0, view.x1], [view.y0, view.y1]];
  const tables = axes.map((axis, n) => {
    const [from, to] = ends[n].map((share) => axis.value(Math.min(1, Math.max(0, share))));
    return `{name="${axis.name}",from=${from},to=${to},count=200,scale="${axis.log ? "log" : "linear"}"}`;
  });
  return scene.command + " --set 'axes=[" + tables.join(",") + "]' -o view.nc";
}

// Each point in view once: a cell of a depth stands only where no finer tile tells it again.
export function csvOf(app) {
  const { view, cache, scene, axes } = app;
  const quoted = (text) => "\"" + text.replaceAll("\"", "\"\"") + "\"";
  const titled = (one) => quoted(one.unit ? one.name + " [" + one.unit + "]" : one.name);
  const rows = [[...axes.map(titled), "status", ...scene.quantities.map(titled)].join(",")];
  for (let depth = view.targetDepth(); depth >= 0; depth--) {
    const cells = 2 ** (depth + 5);
    eachPlace(view, depth, (i, j) => {
      const tile = cache.get(scene.key, depth, i, j);
      if (!tile) return;
      const finer = [0, 1, 2, 3].map((n) => depth < view.targetDepth() &&
        cache.has(scene.key, depth + 1, 2 * i + (n & 1), 2 * j + (n >> 1)));
      for (let k = 0; k < 1024; k++) {
        const column = k & 31;
        const row = k >> 5;
        if (finer[(column >> 4) + 2 * (row >> 4)]) continue;
        const x = (32 * i + column) / cells;
        const y = (32 * j + row) / cells;
        if (x < view.x0 || x > view.x1 || y < view.y0 || y > view.y1) continue;
        const values = scene.quantities.map((quantity, q) => {
          const value = tileValue(tile, q, k);
          if (Number.isNaN(value)) return "";
          return quantity.classes ? quoted(quantity.classes[value] || String(value)) : String(value);
        });
        const status = quoted(statusText(tile.data[k]));
        rows.push([axes[0].value(x), axes[1].value(y), status, ...values].join(","));
      }
    });
  }
  return rows.join("\n") + "\n";
}

export function setUpExports(app, motion) {
  const banner = (error) => {
    app.tell("export", error instanceof ServerError ? error.message : "the server does not answer");
    setTimeout(() => app.tell("export", null), 6000);
  };
  const on = (id, act) => byId(id).addEventListener("click", () => {
    if (app.scene) Promise.resolve(act()).catch(banner);
  });
  on("export-study", () => saveStudy(app));
  on("export-png", () => picture(app).toBlob((blob) => save(blob, "map.png"), "image/png"));
  on("export-svg", () => save(new Blob([pictureSvg(app)], { type: "image/svg+xml" }), "map.svg"));
  on("export-result", () => saveResult(app));
  on("export-csv", () => save(new Blob([csvOf(app)], { type: "text/csv" }), "map.csv"));
  on("copy-link", () => copyText(location.href, byId("copy-link")));
  byId("export").addEventListener("toggle", () => {
    if (!byId("export").open || !app.scene) return;
    const lines = [runCommand(app), ...(motion.data ? motion.data.commands || [] : [])];
    byId("export-commands").replaceChildren(...lines.filter(Boolean).map(commandLine));
  });
  // A menu closes when something else is used.
  document.addEventListener("pointerdown", (event) => {
    for (const menu of document.querySelectorAll("details.menu[open]")) {
      if (!menu.contains(event.target)) menu.open = false;
    }
  });
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    for (const menu of document.querySelectorAll("details.menu[open]")) menu.open = false;
  });
}
