// Makes elements of the page.

export function make(tag, text, className) {
  const element = document.createElement(tag);
  if (text !== undefined) element.textContent = text;
  if (className) element.className = className;
  return element;
}

export function button(text, label, act) {
  const made = make("button", text);
  made.type = "button";
  made.setAttribute("aria-label", label);
  made.addEventListener("click", act);
  return made;
}

export function chooser(label, onChange) {
  const select = document.createElement("select");
  select.setAttribute("aria-label", label);
  select.addEventListener("change", onChange);
  return select;
}

// Keeps the choice where it is still there.
export function fill(select, names, fallback) {
  const kept = names.includes(select.value) ? select.value : names[Math.min(fallback, names.length - 1)];
  select.replaceChildren(...names.map((name) => new Option(name, name)));
  select.value = kept;
}

// A colour and what it stands for.
export function keyLine(color, text) {
  const line = make("span", undefined, "key");
  const swatch = make("span", undefined, "swatch");
  swatch.style.background = color;
  line.append(swatch, text);
  return line;
}
