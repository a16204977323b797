// Thumbnails of the views seen. A click goes back to one.

const most = 30;

export class Strip {
  constructor(element, onGo) {
    this.element = element;
    this.onGo = onGo;
    this.buttons = new Map();
  }

  // The open motion, the diagram and the contours are no part of a view.
  plain(hash) {
    return hash.replace(/&(at|diagram|state|contours|si)=[^&]*/g, "");
  }

  add(canvas, whole) {
    const hash = this.plain(whole);
    let button = this.buttons.get(hash);
    if (!button) {
      button = document.createElement("button");
      button.type = "button";
      button.append(document.createElement("canvas"));
      button.addEventListener("click", () => this.onGo(hash));
      this.buttons.set(hash, button);
      this.element.append(button);
      button.setAttribute("aria-label", "view " + this.buttons.size);
      if (this.element.children.length > most) {
        const oldest = this.element.firstElementChild;
        oldest.remove();
        for (const [key, value] of this.buttons) if (value === oldest) this.buttons.delete(key);
      }
      this.element.scrollLeft = this.element.scrollWidth;
    }
    const small = button.firstElementChild;
    small.width = 76;
    small.height = 46;
    small.getContext("2d").drawImage(canvas, 0, 0, 76, 46);
    this.mark(hash);
  }

  mark(whole) {
    const hash = this.plain(whole);
    for (const [key, button] of this.buttons) button.setAttribute("aria-current", String(key === hash));
  }
}
