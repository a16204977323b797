// A cache with a limit in bytes: what was not used for longest goes first.

export class AgedCache {
  constructor(limitBytes) {
    this.limit = limitBytes;
    this.bytes = 0;
    this.entries = new Map();
    this.clock = 0;  // whoever draws a picture moves it on
  }

  get(key) {
    const entry = this.entries.get(key);
    if (entry) entry.used = this.clock;
    return entry;
  }

  has(key) { return this.entries.has(key); }

  // size: in bytes
  put(key, entry, size) {
    const old = this.entries.get(key);
    if (old) this.bytes -= old.size;
    this.entries.set(key, Object.assign(entry, { used: this.clock, size }));
    this.bytes += size;
    if (this.bytes > this.limit) this.shrink();
  }

  // Many go at once, so that the sorting is rare. What the last pictures showed stays.
  shrink() {
    const byAge = [...this.entries].sort((a, b) => a[1].used - b[1].used);
    for (const [key, entry] of byAge) {
      if (this.bytes <= 0.8 * this.limit || entry.used >= this.clock - 1) break;
      this.entries.delete(key);
      this.bytes -= entry.size;
    }
  }
}
