// Mouse, touch and keyboard on the map.

const clickWait = 230;

// act: pan(dx, dy), zoom(px, py, factorX, factorY), hover(px, py) or hover(null), click(px, py, pointer type),
// walk(dx, dy), open(), zoomKey(factor), panKey(dx, dy), home(), leave(), waiting(boolean)
export function setUpPointer(canvas, act) {
  const down = new Map();
  let moved = 0;
  let clickTimer = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const forgetClick = () => {
    if (clickTimer) clearTimeout(clickTimer);
    clickTimer = 0;
    act.waiting(false);
  };

  canvas.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse" && event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    if (down.size === 0) moved = 0;
    down.set(event.pointerId, place(event));
  });

  canvas.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = down.get(event.pointerId);
    act.hover(now[0], now[1]);
    if (!before) return;
    if (down.size === 1) {
      moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
      // A hand that trembles still clicks.
      if (moved < 4) return;
      down.set(event.pointerId, now);
      act.pan(now[0] - before[0], now[1] - before[1]);
    } else if (down.size === 2) {
      moved = 100;
      const other = [...down].find((entry) => entry[0] !== event.pointerId)[1];
      const factor = Math.hypot(before[0] - other[0], before[1] - other[1]) /
        Math.max(1, Math.hypot(now[0] - other[0], now[1] - other[1]));
      down.set(event.pointerId, now);
      act.pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
      act.zoom((now[0] + other[0]) / 2, (now[1] + other[1]) / 2, factor, factor);
    }
  });

  const up = (event) => {
    if (!down.delete(event.pointerId) || moved >= 4 || event.type === "pointercancel") return;
    const [px, py] = place(event);
    const type = event.pointerType;
    if (clickTimer) {
      forgetClick();
      act.zoom(px, py, 0.5, 0.5);
      return;
    }
    act.waiting(true);
    clickTimer = setTimeout(() => {
      forgetClick();
      act.click(px, py, type);
    }, clickWait);
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("pointerleave", () => act.hover(null, null));

  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 30 : 1;
    // Some systems turn the wheel sideways while Shift is held.
    const turned = (event.deltaY || event.deltaX) * lines;
    const factor = Math.exp(Math.max(-1, Math.min(1, turned * 0.0022)));
    const [px, py] = place(event);
    act.zoom(px, py, event.altKey ? 1 : factor, event.shiftKey ? 1 : factor);
  }, { passive: false });

  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey) return;
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const step = steps[event.key];
    if (step && event.shiftKey) act.panKey(step[0], step[1]);
    else if (step) act.walk(step[0], step[1]);
    else if (event.key === "+" || event.key === "=") act.zoomKey(0.5);
    else if (event.key === "-" || event.key === "_") act.zoomKey(2);
    else if (event.key === "Enter" || event.key === " ") act.open();
    else if (event.key === "Home" || event.key === "0") act.home();
    else if (event.key === "Escape") act.leave();
    else return;
    event.preventDefault();
  });
}
