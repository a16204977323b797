// Numbers of a model in SI units, where the scene knows the factor.

import { short } from "./ticks.js";

let chosen = false;

export function showSi(on) { chosen = on; }

// How axes and legend show an axis or a quantity: the factor for its numbers, and its title.
export function shownIn(told) {
  const si = chosen ? told.si : null;
  const unit = si ? si.unit : told.unit;
  const name = si && si.meaning ? si.meaning : told.name;
  return { factor: si ? si.factor : 1, title: unit ? name + " [" + unit + "]" : name };
}

// A number without a dimension has the unit 1, which reads as a digit behind another number.
export function unitText(told) {
  return told.unit && told.unit !== "1" ? " " + told.unit : "";
}

// " (12.3 um)" to stand beside a number, or nothing.
export function siText(told, value) {
  if (!told.si || !Number.isFinite(value)) return "";
  return " (" + short(value * told.si.factor, 5) + (told.si.unit ? " " + told.si.unit : "") + ")";
}

export function hasSi(scene) {
  return [...scene.axes, ...scene.quantities, ...scene.choices].some((one) => Boolean(one.si));
}

// The switch is there only where there is something to switch.
export function setUpUnits(box, onChange) {
  const check = box.querySelector("input");
  check.addEventListener("change", () => {
    showSi(check.checked);
    onChange();
  });
  return {
    get si() { return check.checked; },
    choose(on) {
      check.checked = on;
      showSi(on);
    },
    show(scene) { box.hidden = !hasSi(scene); },
  };
}
