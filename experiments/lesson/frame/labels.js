// Places labels so that none covers another: the heavier ones first, each beside its point where there is room. A label
// without room is left out; the sentence under the picture says the same in words.
Lesson.placeLabels = (() => {
  // An estimate that no common font exceeds, so that canvas, slide and test place labels alike.
  const widthOf = (text, fontSize) => 0.62 * fontSize * text.length + 4;

  const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

  // Eight directions at two distances, the usual places first.
  const offsets = [];
  for (const distance of [9, 18]) {
    for (const [dx, dy] of [[1, -1], [1, 0], [-1, -1], [-1, 0], [0, -1], [0, 1], [1, 1], [-1, 1]]) {
      offsets.push([dx * distance, dy * distance, dx]);
    }
  }

  const boxAt = (x, y, [dx, dy, side], width, height) => {
    const left = side > 0 ? x + dx : side < 0 ? x + dx - width : x - width / 2;
    const middle = y + dy;
    return {left, right: left + width, top: middle - height / 2, bottom: middle + height / 2};
  };

  return (labels, view, fontSize) => {
    const height = fontSize + 3;
    const placed = [];
    const order = labels.map((label, i) => [label, i]).sort((a, b) => b[0].weight - a[0].weight || a[1] - b[1]);
    for (const [label] of order) {
      const [x, y] = view.toScreen(label.point);
      const width = widthOf(label.text, fontSize);
      for (const offset of offsets) {
        const box = boxAt(x, y, offset, width, height);
        const isInside = box.left >= 0 && box.top >= 0 && box.right <= view.width && box.bottom <= view.height;
        if (!isInside || placed.some((other) => overlap(other.box, box))) continue;
        placed.push({...label, box, x: box.left + 2, y: box.bottom - 0.3 * fontSize});
        break;
      }
    }
    return placed;
  };
})();
