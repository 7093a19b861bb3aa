"""Reads the input deck of one mesh position that `gearwear export` writes: what a program needs that does not read CalculiX' decks."""

# face number of a triangle: its two corners and the middle node between them, by place in the element
FACES = {1: (0, 1, 3), 2: (1, 2, 4), 3: (2, 0, 5)}
BODIES = ("PINION", "GEAR")


class Deck:
    """Nodes, elements, flanks, supports and load, by the numbers of the deck."""

    def __init__(self, file):
        self.nodes = {}
        self.elements = {name: {} for name in BODIES}
        self.flanks = {}  # "PINION_1", "GEAR_1" ...: (element, face) along the flank
        self.materials = {}  # modulus and Poisson's ratio
        self.held = []
        self.bore = []  # nodes of the pinion's bore, which turns as one
        self.turning = None  # the node whose displacement 1 is that turn
        self.angle = self.torque = None
        card, set_, step, equation, material = "", "", 0, [], ""
        for line in file.read_text().splitlines():
            if line.startswith("**"):
                continue
            if line.startswith("*"):
                words = dict(w.strip().split("=") for w in line.split(",")[1:] if "=" in w)
                card = line[1:].split(",")[0].upper()
                set_ = words.get("NSET") or words.get("ELSET") or words.get("NAME") or ""
                if card == "STEP":
                    step += 1
                if card == "MATERIAL":
                    material = set_.removeprefix("OF_")
                continue
            cells = [cell.strip() for cell in line.split(",") if cell.strip()]
            if card == "NODE":
                self.nodes[int(cells[0])] = (float(cells[1]), float(cells[2]))
                if set_ == "TURN":
                    self.turning = int(cells[0])
            elif card == "ELEMENT":
                self.elements[set_][int(cells[0])] = [int(cell) for cell in cells[1:]]
            elif card == "SURFACE":
                self.flanks.setdefault(set_, []).append((int(cells[0]), int(cells[1][1:])))
            elif card == "ELASTIC":
                self.materials[material] = (float(cells[0]), float(cells[1]))
            elif card == "BOUNDARY" and step == 0 and int(cells[0]) != self.turning:
                self.held.append(int(cells[0]))
            elif card == "BOUNDARY" and step == 1:
                self.angle = float(cells[3])
            elif card == "EQUATION" and len(cells) > 1:
                equation.append(int(cells[0]))
            elif card == "CLOAD":
                self.torque = float(cells[2])
        self.bore = equation[::2]

    def unknowns(self):
        """Displacements that are not held, those that the pinion's bore gives up for its turn among them."""
        return 2 * (len(self.nodes) - 1) - 2 * len(self.held) - 2 * len(self.bore) + 1

    def pairs(self):
        return sum(name.startswith("GEAR_") for name in self.flanks)

    def faces(self, flank):
        """Node numbers of the element faces along a flank, middle nodes among them, each in its element's sense."""
        elements = {**self.elements["PINION"], **self.elements["GEAR"]}
        for element, face in self.flanks[flank]:
            nodes = elements[element]
            first, last, middle = FACES[face]
            yield [nodes[i] for i in (first, middle, last) if i < len(nodes)]

    def edges(self, flank):
        """Pairs of neighbouring nodes along a flank, in the sense of the elements."""
        return [edge for face in self.faces(flank) for edge in zip(face, face[1:])]

    def along(self, flank):
        """Nodes along a flank, each once."""
        faces = list(self.faces(flank))
        if faces[0][-1] not in faces[1]:
            faces = [face[::-1] for face in faces]
        if any(a[-1] != b[0] for a, b in zip(faces, faces[1:])):
            raise ValueError(f"the faces of {flank} do not follow one another")
        return faces[0][:1] + [node for face in faces for node in face[1:]]
