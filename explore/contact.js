// The flanks of gear teeth in a time history: on which side they touch shades the ground.

import { keyLine } from "./elements.js";

const states = [
  { value: 1, name: "drive flank", color: "rgba(47,134,214,0.32)" },
  { value: 0, name: "gap", color: "transparent" },
  { value: -1, name: "back flank", color: "rgba(224,130,20,0.34)" },
  { value: 2, name: "wedged", color: "rgba(150,80,200,0.38)" },
];

function seriesOf(data, name) {
  const k = (data.channels || []).findIndex((channel) => channel.name === name);
  return k < 0 ? null : data.series[k];
}

// Channels of that name that tell nothing but these states: other models have signals called so, too.
export function contactChannels(data) {
  const names = (data.channels || []).map((channel) => channel.name);
  return names.filter((name) => (name === "contact" || name.startsWith("contact_")) &&
    seriesOf(data, name).every((value) => states.some((state) => state.value === value)));
}

// Stretches of one state: [{ from, to, color }], in the time of the history.
export function contactBands(data, name) {
  const series = seriesOf(data, name);
  const tau = data.tau;
  const bands = [];
  let begin = 0;
  for (let k = 1; k <= series.length; k++) {
    if (k < series.length && series[k] === series[begin]) continue;
    const { color } = states.find((state) => state.value === series[begin]);
    const from = begin === 0 ? tau[0] : (tau[begin - 1] + tau[begin]) / 2;
    const to = k === series.length ? tau[k - 1] : (tau[k - 1] + tau[k]) / 2;
    if (color !== "transparent") bands.push({ from, to, color });
    begin = k;
  }
  return bands;
}

// What the colours mean, and how much of the time each state takes.
export function contactKey(data, name) {
  const series = seriesOf(data, name);
  const shareOf = (state) => series.filter((value) => value === state.value).length / series.length;
  return states.map((state) => [state, shareOf(state)]).filter((entry) => entry[1] > 0)
    .map(([state, share]) => keyLine(state.color, state.name + " " + percent(share)));
}

export function percent(share) {
  const digits = share > 0 && share < 0.01 || share < 1 && share > 0.99 ? 1 : 0;
  return (100 * share).toFixed(digits) + " %";
}

// A history shows the force between the teeth first, where there is one.
export function forceChannel(names) {
  return names.findIndex((name) => name === "dmf" || name.startsWith("force") || name.startsWith("f_"));
}
