// The pictures of each scene that are no tiles. The newest previews are kept, one a scene.

const mostPreviews = 16;

export class Layers {
  constructor() {
    this.previews = new Map();
    this.files = new Map();
  }

  putPreview(scene, grid) {
    this.previews.delete(scene);
    this.previews.set(scene, grid);
    if (this.previews.size > mostPreviews) this.previews.delete(this.previews.keys().next().value);
  }

  // null: the file's numbers could not be had.
  putFile(scene, grid) { this.files.set(scene, grid); }

  // Coarse ones first.
  of(scene) {
    const found = [this.files.get(scene), this.previews.get(scene)].filter(Boolean);
    return found.sort((a, b) => a.depth - b.depth);
  }
}

// Coarser tiles belong below a grid, finer ones above it, and those that the view asks for above all.
export function tileDepthAbove(grid, target) {
  return Math.min(target, Math.max(0, Math.ceil(grid.depth - 5.01)));
}
