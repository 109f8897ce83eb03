// Unpacks what the program has packed with zlib (RFC 1950 and 1951), so that a page can hold a long run. Browsers can
// do it, too, but not before the page begins.
Lesson.inflate = (() => {
  // Codes of up to 15 bits, looked up by the next 15 bits: symbol * 16 + length of the code.
  const kBits = 15;

  // The canonical Huffman code with these lengths (RFC 1951, 3.2.2).
  const tableOf = (lengths) => {
    const table = new Uint16Array(1 << kBits);
    let code = 0;
    for (let length = 1; length <= kBits; ++length) {
      for (let symbol = 0; symbol < lengths.length; ++symbol) {
        if (lengths[symbol] !== length) continue;
        // Codes come with their first bit first, numbers with their last.
        let reversed = 0;
        for (let bit = 0; bit < length; ++bit) reversed |= ((code >> bit) & 1) << (length - 1 - bit);
        for (let at = reversed; at < table.length; at += 1 << length) table[at] = symbol * 16 + length;
        ++code;
      }
      code <<= 1;
    }
    return table;
  };

  // Lengths of repetitions from symbol 257 on, and distances: the first of each symbol and its number of extra bits.
  const rangesOf = (first, extras) => {
    const starts = [];
    let next = first;
    for (const extra of extras) {
      starts.push(next);
      next += 1 << extra;
    }
    return {starts, extras};
  };
  const lengthRanges = rangesOf(3, [...Array(8).fill(0), ...[1, 2, 3, 4, 5].flatMap((extra) => Array(4).fill(extra))]);
  lengthRanges.starts.push(258);
  lengthRanges.extras.push(0);
  const distanceRanges =
      rangesOf(1, [0, 0, 0, 0, ...Array.from({length: 13}, (_, extra) => [extra + 1, extra + 1]).flat()]);
  const kLengthOrder = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
  const fixed = [
    tableOf([...Array(144).fill(8), ...Array(112).fill(9), ...Array(24).fill(7), ...Array(8).fill(8)]),
    tableOf(Array(30).fill(5))
  ];

  class Reader {
    constructor(bytes) { Object.assign(this, {bytes, at: 2, held: 0, count: 0}); }  // behind zlib's two bytes

    fill(count) {
      while (this.count < count) {
        this.held |= (this.bytes[this.at++] ?? 0) << this.count;
        this.count += 8;
      }
    }

    drop(count) {
      this.held >>>= count;
      this.count -= count;
    }

    bits(count) {
      if (count === 0) return 0;
      this.fill(count);
      const value = this.held & ((1 << count) - 1);
      this.drop(count);
      return value;
    }

    symbol(table) {
      this.fill(kBits);
      const entry = table[this.held & ((1 << kBits) - 1)];
      if ((entry & 15) === 0) throw new Error("the data of this page are damaged");
      this.drop(entry & 15);
      return entry >> 4;
    }

    value({starts, extras}, symbol) { return starts[symbol] + this.bits(extras[symbol]); }
  }

  // The two codes of a block that brings its own (RFC 1951, 3.2.7).
  const readTables = (reader) => {
    const [literals, distances, count] = [reader.bits(5) + 257, reader.bits(5) + 1, reader.bits(4) + 4];
    const ofLengths = Array(19).fill(0);
    for (let i = 0; i < count; ++i) ofLengths[kLengthOrder[i]] = reader.bits(3);
    const table = tableOf(ofLengths);
    const lengths = [];
    while (lengths.length < literals + distances) {
      const symbol = reader.symbol(table);
      if (symbol < 16) lengths.push(symbol);
      if (symbol < 16) continue;
      const repeated = symbol === 16 ? lengths[lengths.length - 1] : 0;
      const times = symbol === 16 ? 3 + reader.bits(2) : symbol === 17 ? 3 + reader.bits(3) : 11 + reader.bits(7);
      for (let i = 0; i < times; ++i) lengths.push(repeated);
    }
    return [tableOf(lengths.slice(0, literals)), tableOf(lengths.slice(literals))];
  };

  const readStored = (reader, out, size) => {
    reader.at -= reader.count >> 3;  // bytes that were read ahead
    reader.held = reader.count = 0;
    const length = reader.bytes[reader.at] + 256 * reader.bytes[reader.at + 1];
    out.set(reader.bytes.subarray(reader.at + 4, reader.at + 4 + length), size);
    reader.at += 4 + length;
    return size + length;
  };

  const readBlock = (reader, [literals, distances], out, size) => {
    for (;;) {
      const symbol = reader.symbol(literals);
      if (symbol === 256) return size;
      if (symbol < 256) {
        out[size++] = symbol;
        continue;
      }
      const length = reader.value(lengthRanges, symbol - 257);
      const distance = reader.value(distanceRanges, reader.symbol(distances));
      for (let i = 0; i < length; ++i, ++size) out[size] = out[size - distance];
    }
  };

  // The bytes, of which there are `length`.
  return (bytes, length) => {
    const reader = new Reader(bytes);
    const out = new Uint8Array(length);
    let size = 0;
    for (let isLast = false; !isLast;) {
      isLast = reader.bits(1) === 1;
      const kind = reader.bits(2);
      if (kind === 0)
        size = readStored(reader, out, size);
      else
        size = readBlock(reader, kind === 1 ? fixed : readTables(reader), out, size);
    }
    if (size !== length) throw new Error("the data of this page are damaged");
    return out;
  };
})();

// The data of the page: JSON, packed, in base 64.
Lesson.unpack = (text, length) => {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return JSON.parse(new TextDecoder().decode(Lesson.inflate(packed, length)));
};
