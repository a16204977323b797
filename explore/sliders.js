// A slider and a field for each parameter and initial state that is not on an axis.

import { siText } from "./units.js";

// A model allows far more than one looks at: a slider goes from 0 to twice the first value seen, or
// 1 to either side of 0; of a state as far as motions go. The field takes all that is allowed.
function limits(choice) {
  const { value } = choice;
  let [low, high] = [Math.min(0, 2 * value), Math.max(0, 2 * value)];
  if (value === 0) [low, high] = [value - 1, value + 1];
  if (choice.is_state && choice.low !== null) {
    [low, high] = [Math.min(value, choice.low), Math.max(value, choice.high)];
  }
  if (choice.min !== null) low = Math.max(low, choice.min);
  if (choice.max !== null) high = Math.min(high, choice.max);
  return [low, high];
}

// The last digits of a quotient say nothing, and a field that cuts 0.5999999999999999 off shows 0.59999.
const shortest = (value) => Number(value.toPrecision(12));

export class Sliders {
  constructor(element, filter, keeper) {
    this.filter = filter;
    this.keeper = keeper;
    this.rows = new Map();
    this.groups = [this.makeGroup(element, "parameters"), this.makeGroup(element, "initial states")];
    filter.addEventListener("input", () => this.sift());
  }

  makeGroup(parent, title) {
    const box = document.createElement("div");
    const head = document.createElement("h3");
    const list = document.createElement("div");
    head.id = "group-" + title.replace(" ", "-");
    head.textContent = title;
    box.className = "group";
    box.setAttribute("role", "group");
    box.setAttribute("aria-labelledby", head.id);
    box.append(head, list);
    box.hidden = true;
    parent.append(box);
    return { box, list };
  }

  makeRow(choice) {
    const box = document.createElement("div");
    const label = document.createElement("label");
    const field = document.createElement("input");
    const slide = document.createElement("input");
    const reset = document.createElement("button");
    const si = document.createElement("span");
    const [low, high] = limits(choice);
    const title = choice.unit ? choice.name + " [" + choice.unit + "]" : choice.name;
    box.className = "slider";
    box.dataset.name = choice.name;
    box.title = choice.meaning;
    field.type = "number";
    field.step = "any";
    field.id = "set-" + choice.name;
    if (choice.min !== null) field.min = choice.min;
    if (choice.max !== null) field.max = choice.max;
    label.htmlFor = field.id;
    label.textContent = title;
    slide.type = "range";
    slide.min = low;
    slide.max = high;
    slide.step = "any";
    slide.setAttribute("aria-label", title + " slider");
    reset.type = "button";
    reset.textContent = "x";
    reset.setAttribute("aria-label", "reset " + choice.name);
    reset.title = "reset";
    si.className = "si";
    si.hidden = !choice.si;
    slide.addEventListener("input", () => {
      // Six digits are finer than a pixel of the slider.
      const value = Number(slide.valueAsNumber.toPrecision(6));
      field.value = value;
      si.textContent = siText(choice, value);
      box.classList.add("changed");
      this.keeper.drag(choice.name, value);
    });
    slide.addEventListener("change", () => this.keeper.rest(150));
    field.addEventListener("change", () => {
      const value = field.valueAsNumber;
      if (Number.isNaN(value)) return;
      slide.value = value;
      si.textContent = siText(choice, value);
      box.classList.add("changed");
      this.keeper.set(choice.name, value);
    });
    // What is no number, or was refused, does not stay.
    field.addEventListener("blur", () => {
      if (!this.keeper.busy) field.value = shortest(this.rows.get(choice.name).value);
    });
    reset.addEventListener("click", () => this.keeper.set(choice.name, null));
    box.append(label, field, reset, slide, si);
    return { box, field, slide, si, isRough: choice.low === null };
  }

  // The value that a scene has for a row.
  update(row, choice) {
    row.box.classList.toggle("changed", this.keeper.sets.has(choice.name));
    row.value = choice.value;
    row.words = (choice.name + " " + choice.meaning).toLowerCase();
    // A slider that moves is ahead of the scenes.
    if (document.activeElement === row.slide && this.keeper.busy) return;
    // A field that is being edited keeps what is typed.
    if (document.activeElement !== row.field) row.field.value = shortest(choice.value);
    row.si.textContent = siText(choice, choice.value);
    if (document.activeElement === row.slide) return;
    if (row.isRough && choice.low !== null) {
      row.isRough = false;
      [row.slide.min, row.slide.max] = limits(choice);
    }
    row.slide.min = Math.min(row.slide.min, choice.value);
    row.slide.max = Math.max(row.slide.max, choice.value);
    row.slide.value = choice.value;
  }

  show(scene) {
    const onAxes = scene.axes.map((axis) => axis.name);
    const shown = [[], []];
    // A state without a value can only be on an axis; elsewhere points start as the study says.
    for (const choice of scene.choices.filter((each) => each.value !== null)) {
      if (!this.rows.has(choice.name)) this.rows.set(choice.name, this.makeRow(choice));
      const row = this.rows.get(choice.name);
      this.update(row, choice);
      if (!onAxes.includes(choice.name)) shown[choice.is_state ? 1 : 0].push(row.box);
    }
    // Rows move only when the set of them changes, so that focus stays where it is.
    this.groups.forEach(({ list }, k) => {
      const now = [...list.children];
      const other = now.length !== shown[k].length || now.some((box, n) => box !== shown[k][n]);
      if (other) list.replaceChildren(...shown[k]);
    });
    this.sift();
  }

  sift() {
    const wanted = this.filter.value.trim().toLowerCase();
    for (const row of this.rows.values()) row.box.hidden = !row.words.includes(wanted);
    for (const { box, list } of this.groups) box.hidden = [...list.children].every((row) => row.hidden);
  }
}
