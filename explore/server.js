// All requests to the server, and the reader of its stream of tiles.

export class ServerError extends Error {
  constructor(status, text) {
    super(text);
    this.status = status;
  }
}

async function checked(response) {
  if (response.ok) return response;
  let text = "the server answered with status " + response.status;
  try {
    const told = await response.json();
    if (told && typeof told.error === "string") text = told.error;
  } catch { /* the answer was no JSON: the status must do */ }
  throw new ServerError(response.status, text);
}

export async function getJson(address, signal) {
  return (await checked(await fetch(address, { signal }))).json();
}

export async function getBlob(address, signal) {
  return (await checked(await fetch(address, { signal }))).blob();
}

export async function getText(address, signal) {
  return (await checked(await fetch(address, { signal }))).text();
}

// Joins the chunks of a stream into records of 8 numbers and n more.
export class RecordReader {
  constructor(onRecord) {
    this.onRecord = onRecord;
    this.begin(64, null);
  }

  begin(bytes, head) {
    this.bytes = new Uint8Array(bytes);
    this.filled = 0;
    this.head = head;
  }

  add(chunk) {
    let at = 0;
    while (at < chunk.length) {
      const part = Math.min(chunk.length - at, this.bytes.length - this.filled);
      this.bytes.set(chunk.subarray(at, at + part), this.filled);
      this.filled += part;
      at += part;
      if (this.filled === this.bytes.length) this.full();
    }
  }

  full() {
    const numbers = new Float64Array(this.bytes.buffer);
    if (this.head === null) {
      if (numbers[4] > 0) {
        this.begin(8 * numbers[4], numbers);
        return;
      }
      this.begin(64, null);
      this.onRecord(numbers, new Float64Array(0));
      return;
    }
    const head = this.head;
    this.begin(64, null);
    this.onRecord(head, numbers);
  }
}

// Posts a request, and calls with each record of the answer as it comes.
export async function readRecords(address, request, signal, onRecord) {
  await recordsOf(await checked(await fetch(address, {
    method: "POST", signal, body: JSON.stringify(request), headers: { "Content-Type": "application/json" },
  })), onRecord);
}

export async function getRecords(address, onRecord) {
  await recordsOf(await checked(await fetch(address)), onRecord);
}

async function recordsOf(response, onRecord) {
  const records = new RecordReader(onRecord);
  const reader = response.body.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    records.add(value);
  }
}

export function textOf(numbers) {
  return new TextDecoder().decode(new Uint8Array(numbers.buffer)).replace(/\0+$/, "");
}
