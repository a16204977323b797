// The choices in the head of the page and of the axes. None of the colours asks the server.

import { paletteNames, scaleNames } from "./colors.js";
import { shownIn } from "./units.js";

const byId = (id) => document.getElementById(id);

function options(select, pairs, chosen) {
  select.replaceChildren(...pairs.map(([value, text]) => new Option(text, value)));
  select.value = chosen;
}

export class Controls {
  // job: scene(), onLook(), onHome(), onAxes(x, y), onReset(), contours() -> name, onContours(name)
  constructor(colors, job) {
    this.colors = colors;
    this.job = job;
    const look = colors.look;
    options(byId("scale"), scaleNames, look.scale);
    options(byId("palette"), paletteNames, look.palette);
    this.on("quantity", (value) => {
      look.quantity = value;
      colors.forget(job.scene());
    });
    this.on("palette", (value) => { look.palette = value; });
    this.on("scale", (value) => {
      const map = colors.map;
      if (value === "fixed" && map && map.kind !== "classes") colors.setEnds(map.low, map.high);
      look.scale = value;
    });
    for (const id of ["low", "high"]) {
      byId(id).addEventListener("input", () => {
        const value = byId(id).valueAsNumber;
        if (Number.isNaN(value)) return;
        look[id] = value / this.factor;
        this.renew();
      });
    }
    byId("fit").addEventListener("click", () => {
      if (look.scale === "fixed" && job.scene()) colors.fitEnds(job.scene());
      colors.fit();
      this.showLook();
      this.renew();
    });
    byId("home").addEventListener("click", () => job.onHome());
    byId("reset-all").addEventListener("click", () => job.onReset());
    byId("contours").addEventListener("change", (event) => job.onContours(event.target.value));
    byId("xaxis").addEventListener("change", (event) => this.changeAxis(0, event.target.value));
    byId("yaxis").addEventListener("change", (event) => this.changeAxis(1, event.target.value));
  }

  on(id, take) {
    byId(id).addEventListener("change", (event) => {
      take(event.target.value);
      this.showLook();
      this.renew();
    });
  }

  // The ends of the colours are in the units of the legend.
  get factor() {
    const scene = this.job.scene();
    return scene ? shownIn(scene.quantities[this.colors.quantityIndex(scene)]).factor : 1;
  }

  renew() {
    this.colors.renew(this.job.scene());
    this.job.onLook();
  }

  // The same name on both axes means that they change places.
  changeAxis(n, name) {
    // Another choice may be on its way already: the other field has it.
    const shown = this.job.scene().axes.map((axis) => axis.name);
    const names = [byId("xaxis").value, byId("yaxis").value];
    if (names[1 - n] === name) names[1 - n] = shown[n];
    this.job.onAxes(names[0], names[1]);
  }

  showLook() {
    const look = this.colors.look;
    byId("scale").value = look.scale;
    byId("palette").value = look.palette;
    byId("ends").hidden = look.scale !== "fixed";
    for (const id of ["low", "high"]) byId(id).value = Number((look[id] * this.factor).toPrecision(6));
    byId("quantity").value = look.quantity;
    byId("contours").value = this.job.contours();
  }

  showScene(scene) {
    options(byId("quantity"), scene.quantities.map((quantity) => [quantity.name, quantity.name]),
      this.colors.look.quantity);
    options(byId("contours"), [["", "none"], ...scene.quantities.map((quantity) => (
      [quantity.name, quantity.classes ? quantity.name + " (borders)" : quantity.name]))],
      this.job.contours());
    this.showLook();
    const names = scene.choices.map((choice) => [choice.name, choice.name]);
    options(byId("xaxis"), names, scene.axes[0].name);
    options(byId("yaxis"), names, scene.axes[1].name);
    byId("title").textContent = scene.title || "gearsweep explore";
    byId("title").title = scene.title;
    document.title = (scene.title || scene.model) + " - gearsweep explore";
    const first = "Model " + scene.model + ", study " + scene.source + ".";
    const texts = [first, scene.step, ...(scene.notices || [])];
    byId("about-text").replaceChildren(...texts.filter(Boolean).map((text) => {
      const line = document.createElement("p");
      line.textContent = text;
      return line;
    }));
  }
}
