// Which colours the map has now, and when they follow the numbers in view.

import { colorMap, rangeOf } from "./colors.js";
import { valuesInView } from "./inview.js";
import { missingAt } from "./tiles.js";

export class ColorState {
  constructor(cache, layers, view, painter) {
    this.cache = cache;
    this.layers = layers;
    this.view = view;
    this.painter = painter;
    this.look = { quantity: "", scale: "linear", palette: "auto", low: 0, high: 1 };
    this.range = null;
    this.map = null;
    this.fitting = true;
    this.fittedDepth = -1;
    this.legendOld = true;
  }

  quantityIndex(scene) {
    return Math.max(0, scene.quantities.findIndex((quantity) => quantity.name === this.look.quantity));
  }

  fit() {
    this.fitting = true;
    this.fittedDepth = -1;
  }

  // Another quantity has nothing to do with the old range.
  forget(scene) {
    this.range = null;
    this.fit();
    this.renew(scene);
  }

  // Once there are colours, they stay as they are while the view moves.
  viewMoved() {
    if (this.fitting && this.range && this.fittedDepth >= 0) {
      this.fitting = this.fittedDepth < this.view.coarsestDepth();
    }
  }

  renew(scene) {
    if (!scene) return;
    this.map = colorMap(scene.quantities[this.quantityIndex(scene)], this.look, this.range);
    this.painter.recolor();
    this.legendOld = true;
  }

  // While the first tiles come, the range follows them, one depth at a time.
  follow(scene, stillLoading) {
    if (this.fitting) {
      const complete = !stillLoading &&
        missingAt(this.cache, scene.key, this.view, this.view.targetDepth()).length === 0;
      const { values, depth } = this.values(scene);
      if (depth <= this.fittedDepth && this.range) {
        if (complete) this.fitting = false;
      } else {
        const found = rangeOf(values);
        if (found) {
          this.fittedDepth = depth;
          this.range = found;
          this.renew(scene);
        }
        if (complete) this.fitting = false;
      }
    }
    if (!this.map) this.renew(scene);
  }

  values(scene) {
    return valuesInView(this.cache, this.layers, scene.key, this.view, this.quantityIndex(scene));
  }

  // Fixed ends begin with what is shown, in few digits.
  setEnds(low, high) {
    this.look.low = Number(low.toPrecision(4));
    this.look.high = Number(high.toPrecision(4));
  }

  fitEnds(scene) {
    const found = rangeOf(this.values(scene).values);
    if (found) this.setEnds(found.low, found.high);
  }
}
