// Motions from other starts at the open point: the button that asks for them, their points over the phase
// portrait, and what each is.

import { percent } from "./contact.js";
import { button, keyLine, make } from "./elements.js";

const colors = ["#d0453c", "#109b78", "#d9770b", "#8a63d2", "#a08020", "#c25fa8", "#2fa8c6"];

const colorOf = (k) => colors[k % colors.length];

export class Starts {
  // onAsk(): asks the server for them.
  constructor(box, onAsk) {
    this.button = button("other starts", "look for other motions at this point, from other starts", onAsk);
    this.list = make("div", undefined, "keys");
    this.list.setAttribute("role", "status");
    this.row = make("div", undefined, "keys");
    this.row.append(this.button, this.list);
    box.append(this.row);
  }

  // told: nothing, { waiting }, { trouble } or the server's answer. names: the channels of the portrait. There are
  // none for an orbit on a curve.
  show(told, names, some) {
    this.row.hidden = !some;
    this.button.disabled = Boolean(told && told.waiting);
    if (!told || !told.attractors) {
      const text = !told ? "" : told.waiting ? "computing motions from other starts" : told.trouble;
      this.list.replaceChildren(...(text ? [make("span", text)] : []));
      return;
    }
    const lines = told.attractors.map((one, k) => keyLine(colorOf(k), percent(one.share) + ": " + one.text));
    const rest = [["undecided", told.undecided], ["diverged", told.diverged]].filter((entry) => entry[1] > 0)
      .map(([name, share]) => make("span", percent(share) + ": " + name));
    const shown = told.attractors.some((one) => this.places(one, names) !== null);
    const note = shown ? [] : [make("span", "Choose two states above to see their points.")];
    this.list.replaceChildren(make("span", "Of " + told.starts + " starts:"), ...lines, ...rest, ...note);
  }

  places(attractor, names) {
    const at = names.map((name) => attractor.section.channels.indexOf(name));
    return at.every((k) => k >= 0) && attractor.section.points.length > 0 ? at : null;
  }

  // Dots for the phase portrait of these two channels.
  curves(told, names) {
    if (!told || !told.attractors) return [];
    return told.attractors.map((one, k) => {
      const at = this.places(one, names);
      const { points } = one.section;
      return at && { x: points.map((point) => point[at[0]]), y: points.map((point) => point[at[1]]),
        color: colorOf(k), dots: points.length > 16 ? 2.6 : 4, name: "from other starts: " + one.text };
    }).filter(Boolean);
  }
}
