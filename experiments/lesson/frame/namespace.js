// The page is one file and loads nothing, so its modules are plain scripts that share one name. Each module adds one
// property to it; modules.txt has the order.
"use strict";

const Lesson = {};

// An element with attributes and children; strings become text. `on...` attributes are functions.
Lesson.element = (name, attributes = {}, ...children) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on"))
      element.addEventListener(key.slice(2), value);
    else if (value === true)
      element.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined)
      element.setAttribute(key, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
};

// Random numbers that depend on the seed alone (splitmix with 32 bits): every student can have an instance of his own,
// and get it again.
Lesson.Random = class {
  constructor(seed) {
    // Seeds may have 64 bits, as those of the program.
    const bits = BigInt.asUintN(64, BigInt(seed));
    this.state = (Number(bits & 0xffffffffn) ^ Math.imul(Number(bits >> 32n), 0x85ebca6b)) | 0;
  }

  bits() {
    this.state = (this.state + 0x9e3779b9) | 0;
    let z = this.state;
    z = Math.imul(z ^ (z >>> 16), 0x21f0aaad);
    z = Math.imul(z ^ (z >>> 15), 0x735a2d97);
    return (z ^ (z >>> 15)) >>> 0;
  }

  // At least 0, below 1.
  uniform() { return this.bits() / 4294967296; }

  between(low, high) { return low + (high - low) * this.uniform(); }

  below(count) { return Math.floor(this.uniform() * count); }
};

// Numbers as texts and cards show them: three significant digits, no exponent for what a reader compares.
Lesson.numberText = (value) => {
  if (value === Infinity) return "∞";
  if (!Number.isFinite(value)) return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e6) return String(value);
  const size = Math.abs(value);
  if (size >= 100) return value.toFixed(0);
  if (size >= 10) return value.toFixed(1);
  if (size >= 0.01) return value.toFixed(2);
  return value.toPrecision(2);
};

Lesson.countText = (count, one, many = `${one}s`) => `${count} ${count === 1 ? one : many}`;
