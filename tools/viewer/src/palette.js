// Colours of values. The tables come with the page, so that pages and pictures agree.

/** "#532583" -> [83, 37, 131] */
export function channels(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

export class Palette {
  constructor({ scalar, categories, plain }) {
    this.scalar = scalar;
    this.categories = categories;
    this.plain = plain;
  }

  category(number) {
    return this.categories[number % this.categories.length];
  }

  /** The colour of a layer without an attribute. */
  plainOf({ name, shape }) {
    return this.plain.names[name] ?? this.plain.shapes[shape];
  }

  /** A CSS gradient from the smallest to the largest value. */
  gradient(direction = 'to right') {
    const stops = 16;
    const at = (i) => this.scalar[Math.round((i / stops) * (this.scalar.length - 1))];
    return `linear-gradient(${direction}, ${Array.from({ length: stops + 1 }, (_, i) => at(i)).join(', ')})`;
  }
}
