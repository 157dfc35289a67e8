// The arrays of the page: base64 of zlib of bytes ordered by significance; integers are differences.
// tools/ballflow/show/page/blocks.hpp writes them.

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The array of a block: Float32Array, Uint32Array or Uint8Array. */
export async function unpack({ type, count }, text) {
  const bytes = await inflated(fromBase64(text));
  const size = type === 'u8' ? 1 : 4;
  if (bytes.length !== size * count) throw new Error(`a block has ${bytes.length} bytes, not ${size * count}`);
  if (size === 1) return bytes;
  const words = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    words[i] = bytes[i] | (bytes[count + i] << 8) | (bytes[2 * count + i] << 16) | (bytes[3 * count + i] << 24);
  }
  if (type === 'f32') return new Float32Array(words.buffer);
  let value = 0;
  for (let i = 0; i < count; ++i) {
    value += (words[i] >>> 1) ^ -(words[i] & 1);
    words[i] = value;
  }
  return words;
}

/** Unpacks the blocks of a page when they are asked for, each once. */
export class Blocks {
  #known = new Map();

  constructor(list, textOf) {
    this.list = list;
    this.textOf = textOf;
  }

  get(number) {
    if (!this.#known.has(number)) this.#known.set(number, unpack(this.list[number], this.textOf(number)));
    return this.#known.get(number);
  }
}
