// A line of text with a button that copies it.

export async function copyText(text, button) {
  const before = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = "copied";
  } catch {
    // Without leave to copy, the text can still be selected with one click.
    button.textContent = "select it";
  }
  setTimeout(() => { button.textContent = before; }, 1500);
}

export function commandLine(text) {
  const box = document.createElement("div");
  const code = document.createElement("code");
  const button = document.createElement("button");
  box.className = "command";
  code.textContent = text;
  button.type = "button";
  button.textContent = "copy";
  button.setAttribute("aria-label", "copy the command " + text);
  button.addEventListener("click", () => copyText(text, button));
  box.append(code, button);
  return box;
}
