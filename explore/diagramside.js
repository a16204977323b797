// Beside a diagram: what it shows, the meaning of its lines, and the numbers at the pointer.

import { statusText } from "./readout.js";
import { statusOf } from "./strips.js";
import { short } from "./ticks.js";
import { shownIn, siText } from "./units.js";

const byId = (id) => document.getElementById(id);

// Only what changed is written: text that is written anew loses its selection.
function put(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export class DiagramSide {
  // onChoice(along, state)
  constructor(onChoice) {
    this.told = "";
    for (const id of ["diagram-along", "diagram-state"]) {
      byId(id).addEventListener("change", () => onChoice(Number(byId("diagram-along").value),
        byId("diagram-state").value));
    }
  }

  show(line, axes, state, lines, left) {
    const { scene } = line;
    this.state = scene.choices.find((choice) => choice.name === scene.section[state]);
    const now = [scene.key, line.axis, state, lines.map((one) => one.index),
      shownIn(lines[0].quantity).title].join();
    if (now !== this.told) {
      this.told = now;
      this.fill(byId("diagram-along"), ["along x", "along y"].map((text, n) => [n, text]), line.axis);
      this.fill(byId("diagram-state"), scene.section.map((name) => [name, name]), scene.section[state]);
      byId("diagram-lines").replaceChildren(...lines.map((one) => {
        const entry = document.createElement("div");
        const dash = document.createElement("span");
        dash.className = "dash";
        dash.style.background = one.color;
        entry.append(...(one.classes ? [] : [dash]), shownIn(one.quantity).title);
        return entry;
      }));
    }
    const across = axes[1 - line.axis];
    put(byId("diagram-line"), "at " + across.name + " = " + short(across.value(line.share), 5));
    put(byId("diagram-left-over"), left > 0 ? left + (left === 1 ? " strip" : " strips") + " to come" : "");
  }

  fill(select, pairs, chosen) {
    select.replaceChildren(...pairs.map(([value, text]) => new Option(text, value)));
    select.value = String(chosen);
  }

  // A column that is there, and the sample of it that is nearest to the pointer.
  tell(column, sample) {
    let text = "";
    const { state } = this;
    if (column && sample !== null) text = state.name + " " + short(sample, 6) + siText(state, sample);
    else if (column) text = statusOf(column) === 0 ? "no samples" : statusText(statusOf(column));
    put(byId("diagram-told"), text);
  }
}
