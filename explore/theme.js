// Light and dark. The canvases ask here for the colours of the style sheet.

let current = null;

export function themeStyle() {
  if (current) return current;
  const read = getComputedStyle(document.documentElement);
  const color = (name) => read.getPropertyValue(name).trim();
  current = {
    text: color("--text"), faint: color("--faint"), line: color("--line"), outside: color("--outside"),
    back: color("--back"), panel: color("--panel"), accent: color("--accent"),
    hatchBack: color("--hatch-back"), hatchLine: color("--hatch-line"),
    font: "12px system-ui, sans-serif", small: "11px system-ui, sans-serif",
  };
  return current;
}

function remembered() {
  try {
    return localStorage.getItem("gearsweep-theme");
  } catch {
    return null;
  }
}

export function setUpTheme(button, onChange) {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  let chosen = remembered();
  const apply = () => {
    const isDark = chosen ? chosen === "dark" : dark.matches;
    document.documentElement.dataset.theme = isDark ? "dark" : "light";
    button.textContent = isDark ? "light" : "dark";
    button.setAttribute("aria-label", "switch to " + (isDark ? "light" : "dark") + " colours");
    current = null;
    onChange();
  };
  dark.addEventListener("change", apply);
  button.addEventListener("click", () => {
    chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    try {
      localStorage.setItem("gearsweep-theme", chosen);
    } catch { /* without storage the choice lasts until the page closes */ }
    apply();
  });
  apply();
}
