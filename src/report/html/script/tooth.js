// The worn profile of one tooth of each member, its depth magnified, at the slider's state.
function makeTooth(figure, given) {
  const data = given.tooth;
  const parts = data.members.map((member) => ({
    ...member,
    path: figure.querySelector(`path[data-worn="${member.name}"]`),
    depths: given.charts.find((chart) => chart.name === `wear_${member.name}`),
  }));
  return {
    show(state) {
      for (const part of parts) {
        const curve = part.depths && part.depths.curves.find((c) => c.state === state);
        if (!part.path || !curve) continue;
        const number = (v) => v.toFixed(2);
        const worn = part.x.map((x, i) => {
          const deep = curve.y[i] * data.magnified;
          return `${number(x - deep * part.nx[i])} ${number(part.y[i] - deep * part.ny[i])}`;
        });
        const fresh = part.x.map((x, i) => `${number(x)} ${number(part.y[i])}`).reverse();
        part.path.setAttribute("d", `M${worn.join("L")}L${fresh.join("L")}Z`);
      }
    },
  };
}
