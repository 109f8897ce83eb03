// Values that stand in columns in the page's data, as values again (experiments/lesson/columns.h tells how).
Lesson.columns = (() => {
  const intsOf = (text) => {
    const bytes = atob(text.slice(1));
    const each = Number(text[0]);
    const count = bytes.length / each;
    const codes = new Uint32Array(count);
    for (let k = 0; k < each; ++k)
      for (let i = 0; i < count; ++i) codes[i] |= bytes.charCodeAt(k * count + i) << (8 * k);
    return Array.from(codes, (code) => (code & 1 ? -(code + 1) / 2 : code / 2));
  };

  const arraysOf = (sizes, items) => {
    let at = 0;
    return sizes.map((size) => items.slice(at, (at += size)));
  };

  // The n values of a column.
  const valuesOf = (column, n) => {
    if ("same" in column) return Array(n).fill(column.same);
    if (column.values) return column.values;
    if (column.parts) {
      const parts = column.parts.map((part) => valuesOf(part, n));
      return Array.from({length: n}, (_, i) => parts.map((values) => values[i]));
    }
    if (column.sizes) {
      const sizes = valuesOf(column.sizes, n);
      return arraysOf(sizes, valuesOf(column.items, sizes.reduce((sum, size) => sum + size, 0)));
    }
    const ints = intsOf(column.ints);
    return column.scaled ? ints.map((k) => k / column.scaled) : ints;
  };

  const listOf = ({count, column}) => valuesOf(column, count);

  const objectsOf = ({order, kinds}) => {
    const all = kinds.map(({count, columns}) => {
      const keys = Object.keys(columns);
      const values = keys.map((key) => valuesOf(columns[key], count));
      return Array.from({length: count}, (_, i) => Object.fromEntries(keys.map((key, k) => [key, values[k][i]])));
    });
    const next = kinds.map(() => 0);
    return listOf(order).map((kind) => all[kind][next[kind]++]);
  };

  // The triangles of E, whose corners are numbered by its rim.
  const eventOf = (event) => {
    if (event.e !== "refine") return event;
    const gone = event.gone.map((t) => t.map((corner) => event.rim[corner]));
    return {...event, gone, t: event.t ?? gone[0]};
  };

  const eventsOf = (packed) => objectsOf(packed).map(eventOf);

  return {listOf, objectsOf, eventsOf};
})();
