// A slider and a field for each parameter that is not on an axis.

export class Sliders {
  constructor(element, filter, keeper) {
    this.element = element;
    this.filter = filter;
    this.keeper = keeper;
    this.rows = new Map();
    filter.addEventListener("input", () => this.sift());
  }

  // A model allows far more than one looks at: a slider goes from 0 to twice the first value seen, or
  // 1 to either side of 0. The field beside it takes all that is allowed.
  limits(choice) {
    const twice = 2 * choice.value;
    let [low, high] = choice.value === 0 ? [-1, 1] : [Math.min(0, twice), Math.max(0, twice)];
    if (choice.min !== null) low = Math.max(low, choice.min);
    if (choice.max !== null) high = Math.min(high, choice.max);
    return [low, high];
  }

  makeRow(choice) {
    const box = document.createElement("div");
    const label = document.createElement("label");
    const field = document.createElement("input");
    const slide = document.createElement("input");
    const reset = document.createElement("button");
    const [low, high] = this.limits(choice);
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
    const take = (value) => {
      if (Number.isNaN(value)) return;
      box.classList.add("changed");
      this.keeper.set(choice.name, value);
    };
    slide.addEventListener("input", () => {
      // Six digits are finer than a pixel of the slider.
      const value = Number(slide.valueAsNumber.toPrecision(6));
      field.value = value;
      take(value);
    });
    field.addEventListener("change", () => {
      const value = field.valueAsNumber;
      slide.min = Math.min(slide.min, value);
      slide.max = Math.max(slide.max, value);
      slide.value = value;
      take(value);
    });
    reset.addEventListener("click", () => this.keeper.set(choice.name, null));
    box.append(label, field, reset, slide);
    return { box, field, slide };
  }

  show(scene) {
    const onAxes = scene.axes.map((axis) => axis.name);
    const shown = [];
    // An initial state may be on an axis; elsewhere points start as the study says.
    for (const choice of scene.choices.filter((each) => !each.is_state)) {
      if (!this.rows.has(choice.name)) this.rows.set(choice.name, this.makeRow(choice));
      const row = this.rows.get(choice.name);
      row.box.classList.toggle("changed", this.keeper.sets.has(choice.name));
      row.words = (choice.name + " " + choice.meaning).toLowerCase();
      // A field that is being edited keeps what is typed.
      if (document.activeElement !== row.field) row.field.value = choice.value;
      if (document.activeElement !== row.slide) {
        row.slide.min = Math.min(row.slide.min, choice.value);
        row.slide.max = Math.max(row.slide.max, choice.value);
        row.slide.value = choice.value;
      }
      if (!onAxes.includes(choice.name)) shown.push(row.box);
    }
    // Rows move only when the set of them changes, so that focus stays where it is.
    const now = [...this.element.children];
    const other = now.length !== shown.length || now.some((box, k) => box !== shown[k]);
    if (other) this.element.replaceChildren(...shown);
    this.sift();
  }

  sift() {
    const wanted = this.filter.value.trim().toLowerCase();
    for (const row of this.rows.values()) row.box.hidden = !row.words.includes(wanted);
  }
}
