// What the motion panel looks like: plots, values, notes, commands and the list of pins.

import { contactBands, contactChannels, contactKey, forceChannel } from "./contact.js";
import { commandLine } from "./copy.js";
import { button, chooser, fill, make } from "./elements.js";
import { Plot } from "./plots.js";
import { Starts } from "./starts.js";
import { siText, unitText } from "./units.js";

// A value with its unit, where the scene knows more of it than its name.
function withUnit(list, one) {
  const text = one.text || String(one.value);
  const told = list.find((each) => each.name === one.name);
  if (!told || told.classes || !Number.isFinite(one.value)) return text;
  return text + unitText(told) + siText(told, one.value);
}

const historyPeriods = 24;

// The moments of the first periods: more are a black bar.
function momentsShown(data) {
  const end = historyPeriods * data.period;
  const after = data.tau.findIndex((tau) => tau > end * (1 + 1e-9));
  return after < 0 ? data.tau.length : after;
}

export class MotionView {
  // act: close(), pin(), unpin(pin), otherStarts()
  constructor(element, act) {
    this.element = element;
    this.act = act;
    this.layers = [];
    const bar = make("div", undefined, "bar");
    this.heading = make("h2", "");
    bar.append(this.heading, button("pin", "keep this motion to compare", act.pin),
      button("close", "close the motion", act.close));
    this.message = make("p", "");
    this.message.setAttribute("role", "status");
    this.body = make("div", undefined, "body");
    this.pinList = make("div");
    this.values = make("table");
    const again = () => this.plot();
    this.historyChannel = chooser("channel of the history", again);
    this.contactChannel = chooser("contact that shades the history", again);
    this.phaseX = chooser("channel across", again);
    this.phaseY = chooser("channel upwards", again);
    this.spectrumChannel = chooser("channel of the spectrum", again);
    element.append(bar, this.message, this.body);
    this.body.append(this.pinList, this.values);
    this.history = this.section("time history", [this.historyChannel, this.contactChannel], { height: 150 });
    this.contactKeys = make("div", undefined, "keys");
    this.history.box.append(this.contactKeys);
    this.phase = this.section("phase portrait", [this.phaseX, this.phaseY], { height: 230, loose: true });
    this.starts = new Starts(this.phase.box, act.otherStarts);
    this.spectrum = this.section("spectrum", [this.spectrumChannel], { height: 150, logY: true });
    this.multipliers = this.section("multipliers", [], { height: 220, equal: true, circle: true });
    this.multiplierText = make("p", "");
    this.multipliers.box.append(this.multiplierText);
    this.notes = make("div");
    this.commands = make("div");
    this.body.append(make("h3", "notes"), this.notes, make("h3", "commands"), this.commands);
  }

  section(title, choosers, about) {
    const box = make("div");
    const head = make("div", undefined, "choose");
    head.append(make("h3", title), ...choosers);
    box.append(head);
    this.body.append(box);
    return { box, plot: new Plot(box, { label: title, ...about }) };
  }

  wait() {
    this.element.classList.add("waiting");
    this.message.textContent = "computing the motion";
    if (!this.heading.textContent) this.heading.textContent = "motion";
  }

  fail(text) {
    this.element.classList.remove("waiting");
    this.message.textContent = text;
    this.heading.textContent = "no motion";
    this.body.hidden = true;
  }

  show(data, layers, pins, scene) {
    this.element.classList.remove("waiting");
    this.body.hidden = false;
    this.data = data;
    this.layers = layers;
    this.heading.textContent = data.label;
    this.message.textContent = data.status === "ok" ? "" : data.status;
    this.showPins(pins);
    const rows = [...data.at.map((one) => [one.name, withUnit(scene.axes, one)]),
      ...data.values.map((one) => [one.name, withUnit(scene.quantities, one)])];
    this.values.replaceChildren(...rows.map((row) => {
      const line = make("tr");
      line.append(make("td", row[0]), make("td", row[1]));
      return line;
    }));
    const names = (data.channels || []).map((channel) => channel.name);
    fill(this.historyChannel, names, Math.max(0, forceChannel(names)));
    fill(this.contactChannel, contactChannels(data), 0);
    fill(this.phaseX, names, 0);
    // A phase portrait is one of a state and its rate, where a state is that.
    const rate = names.indexOf(data.channels?.[0]?.velocity);
    fill(this.phaseY, names, rate > 0 ? rate : 1);
    fill(this.spectrumChannel, data.spectrum ? data.spectrum.channels : [], 0);
    this.notes.replaceChildren(...(data.notes || []).map((note) => make("p", note)));
    this.commands.replaceChildren(...(data.commands || []).map(commandLine));
    this.plot();
  }

  showPins(pins) {
    this.pinList.replaceChildren(...pins.map((pin) => {
      const line = make("div", undefined, "pin");
      const dot = make("span", undefined, "dot");
      dot.style.background = pin.color;
      line.append(dot, make("span", pin.data.label), button("remove", "remove the pin " + pin.data.label,
        () => this.act.unpin(pin)));
      return line;
    }));
  }

  title(name) {
    const channel = this.data.channels.find((one) => one.name === name);
    return channel && channel.unit ? name + " [" + channel.unit + "]" : name;
  }

  plot() {
    const data = this.data;
    if (!data) return;
    const channel = (layer, name) => {
      const k = (layer.data.channels || []).findIndex((one) => one.name === name);
      return k < 0 ? null : layer.data.series[k];
    };
    const lines = (x, y) => this.layers.map((layer) => ({ x: x(layer), y: y(layer), color: layer.color,
      name: layer.name })).filter((one) => one.x && one.y);
    this.showHistory(lines, channel);
    this.showPhase(lines, channel);
    this.showSpectrum(lines);
    this.showMultipliers();
  }

  showHistory(lines, channel) {
    const name = this.historyChannel.value;
    const some = (this.data.series || []).length > 0;
    this.history.box.hidden = !some;
    if (!some) return;
    const contacts = this.contactChannel.options.length;
    const contact = this.contactChannel.value;
    this.contactChannel.hidden = contacts < 2;
    this.contactKeys.replaceChildren(...(contacts > 0 ? contactKey(this.data, contact) : []));
    const begin = (layer, list) => list && list.slice(0, momentsShown(layer.data));
    this.history.plot.set(
      lines((layer) => begin(layer, layer.data.tau), (layer) => begin(layer, channel(layer, name))),
      this.data.time_unit ? "time [" + this.data.time_unit + "]" : "time", this.title(name),
      contacts > 0 ? contactBands(this.data, contact) : []);
  }

  showPhase(lines, channel) {
    const x = this.phaseX.value;
    const y = this.phaseY.value;
    const some = (this.data.series || []).length > 0;
    this.phase.box.hidden = !some;
    if (!some) return;
    const curves = lines((layer) => channel(layer, x), (layer) => channel(layer, y));
    for (const layer of this.layers) {
      const section = layer.data.section;
      const kx = section ? section.channels.indexOf(x) : -1;
      const ky = section ? section.channels.indexOf(y) : -1;
      if (kx < 0 || ky < 0) continue;
      curves.push({ x: section.points.map((point) => point[kx]), y: section.points.map((point) => point[ky]),
        color: layer.color, dots: 3.2, name: layer.name + ", section" });
    }
    curves.push(...this.starts.curves(this.data.starts, [x, y]));
    this.starts.show(this.data.starts, [x, y], !this.data.is_border);
    this.phase.plot.set(curves, this.title(x), this.title(y));
  }

  showSpectrum(lines) {
    this.spectrum.box.hidden = !this.data.spectrum;
    if (!this.data.spectrum) return;
    const name = this.spectrumChannel.value;
    const amplitude = (layer) => {
      const k = layer.data.spectrum ? layer.data.spectrum.channels.indexOf(name) : -1;
      return k < 0 ? null : layer.data.spectrum.amplitude[k];
    };
    const order = (layer) => (layer.data.spectrum ? layer.data.spectrum.order : null);
    this.spectrum.plot.set(lines(order, amplitude),
      this.data.clockless ? "frequency" : "order", "amplitude of " + this.title(name) + ", Hann window");
  }

  showMultipliers() {
    const { multipliers, multiplierNote } = this.data;
    const comes = this.data.on_orbit && !multiplierNote;
    this.multipliers.box.hidden = !multipliers && !this.data.on_orbit;
    this.multipliers.plot.canvas.hidden = !multipliers && !comes;
    if (this.multipliers.box.hidden) return;
    this.multiplierText.textContent = multipliers ? multipliers.text || ""
      : multiplierNote || "computing the multipliers";
    this.multipliers.plot.set(this.layers.filter((layer) => layer.data.multipliers).map((layer) => ({
      x: layer.data.multipliers.values.map((value) => value[0]),
      y: layer.data.multipliers.values.map((value) => value[1]),
      color: layer.color, dots: 4, name: layer.name,
    })), "real part", "imaginary part");
  }
}
