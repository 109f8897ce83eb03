// The fields that the laboratory offers. All but the first few depend on the seed.
Lesson.fields = (() => {
  const fill = (size, f) => {
    const values = [];
    for (let j = 0; j < size; ++j)
      for (let i = 0; i < size; ++i) values.push(f(i, j));
    return new Lesson.Field(size, size, values);
  };

  // Signed distances, above 0 inside.
  const disc = (x, y, cx, cy, radius) => radius - Math.hypot(x - cx, y - cy);
  const capsule = (x, y, ax, ay, bx, by, radius) => {
    const dx = bx - ax, dy = by - ay;
    const t = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
    return radius - Math.hypot(x - ax - t * dx, y - ay - t * dy);
  };

  // Bumps at random places: smooth, with as many loops as chance will have.
  const bumps = (random, size) => {
    const places = Array.from(
        {length: 7},
        () =>
            [random.between(2, size - 3), random.between(2, size - 3), random.between(1.5, size / 5),
             random.between(-0.6, 1)]);
    return fill(
        size,
        (x, y) => places.reduce(
            (sum, [cx, cy, width, height]) =>
                sum + height * Math.exp(-((x - cx) ** 2 + (y - cy) ** 2) / (width * width)),
            -0.25));
  };

  const list = [
    {name: "ring", title: "ring with an island", make: () => fill(24, (x, y) => Math.max(
        disc(x, y, 11.6, 11.4, 9.3) < 2.1 ? disc(x, y, 11.6, 11.4, 9.3) : 4.2 - disc(x, y, 11.6, 11.4, 9.3),
        disc(x, y, 11.2, 11.9, 2.3)))},
    {name: "touch", title: "two discs that nearly touch", make: () => fill(18, (x, y) => Math.max(
        disc(x, y, 5.2, 8.4, 3.52), disc(x, y, 12.7, 8.6, 3.55)))},
    {name: "finger", title: "disc with a thin finger", make: () => fill(24, (x, y) => Math.max(
        disc(x, y, 6.6, 7.2, 4.6), capsule(x, y, 8, 8, 20.3, 18.6, 0.72)))},
    {name: "flower", title: "flower", make: () => fill(24, (x, y) => {
      const dx = x - 11.4, dy = y - 11.6;
      return 6.6 + 2.6 * Math.cos(5 * Math.atan2(dy, dx)) - Math.hypot(dx, dy);
    })},
    {name: "bumps", title: "random bumps (by seed)", make: (random) => bumps(random, 20)},
    {name: "noise", title: "noise (by seed)", make: (random) => fill(12, () => random.between(-1, 1))},
  ];

  const named = (name, seed) => list.find((field) => field.name === name).make(new Lesson.Random(seed));

  return {list, named, fill, disc, bumps};
})();
