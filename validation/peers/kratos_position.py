"""Solves one mesh position by Kratos Multiphysics; kratos.py starts it in a process of its own, whose processor time is that of the peer.

    python3 kratos_position.py DECK ANSWER.json

Mortar contact with Lagrange multipliers (augmented, frictionless), flanks of the gear as slaves. Kratos has mortar contact of lines with two nodes only, so the
flank of a quadratic triangle becomes two of them: bulk as in the deck, contact surface straight from node to node. Two steps as in the deck: the pinion turned by
the angle that the deck states, then free under the torque."""

import json
import sys
from pathlib import Path

import KratosMultiphysics as KM
import KratosMultiphysics.ContactStructuralMechanicsApplication as CSMA
import KratosMultiphysics.StructuralMechanicsApplication as SMA
from KratosMultiphysics.StructuralMechanicsApplication.structural_mechanics_analysis import StructuralMechanicsAnalysis

from deck import Deck

TOLERANCE = 1e-6


def mdpa(deck):
    """The model in Kratos' own format."""
    out = ["Begin Properties 0", "End Properties"]
    for number in (1, 2):
        out += [f"Begin Properties {number}", "End Properties"]
    # the contact surfaces are no faces of elements (see above), so Kratos cannot find what they belong to, and is told
    for pair in range(1, deck.pairs() + 1):
        out += [f"Begin Properties {10 + pair}", f"YOUNG_MODULUS {deck.materials['GEAR'][0]}", "THICKNESS 1.0", "End Properties"]
    out.append("Begin Nodes")
    out += [f"{n} {x!r} {y!r} 0.0" for n, (x, y) in deck.nodes.items()]
    out.append("End Nodes")
    for number, name in enumerate(("PINION", "GEAR"), 1):
        size = len(next(iter(deck.elements[name].values())))
        out.append(f"Begin Elements SmallDisplacementElement2D{size}N")
        out += [f"{e} {number} {' '.join(map(str, nodes))}" for e, nodes in deck.elements[name].items()]
        out.append("End Elements")
    parts, number = {}, 0
    out.append("Begin Conditions LineCondition2D2N")
    for pair in range(1, deck.pairs() + 1):
        for name in (f"PINION_{pair}", f"GEAR_{pair}"):
            numbers = []
            for a, b in deck.edges(name):
                number += 1
                numbers.append(number)
                out.append(f"{number} {10 + pair} {a} {b}")
            parts[name] = numbers
    out.append("End Conditions")
    out += ["Begin Conditions PointLoadCondition2D1N", f"{number + 1} 0 {deck.turning}", "End Conditions"]

    def part(name, nodes, elements=(), conditions=()):
        out.append(f"Begin SubModelPart {name}")
        for kind, numbers in (("Nodes", nodes), ("Elements", elements), ("Conditions", conditions)):
            out.append(f"Begin SubModelPart{kind}")
            out.extend(map(str, numbers))
            out.append(f"End SubModelPart{kind}")
        out.append("End SubModelPart")

    for name in ("PINION", "GEAR"):
        elements = deck.elements[name]
        part(name, sorted({n for nodes in elements.values() for n in nodes}), elements)
    for pair in range(1, deck.pairs() + 1):
        both = [f"PINION_{pair}", f"GEAR_{pair}"]
        nodes = {name: sorted({n for edge in deck.edges(name) for n in edge}) for name in both}
        part(f"CONTACT_{pair}", sorted({n for name in both for n in nodes[name]}), (), parts[both[0]] + parts[both[1]])
        part(f"SLAVE_{pair}", nodes[both[1]], (), parts[both[1]])
    part("HELD", deck.held)
    part("TURN", [deck.turning], (), [number + 1])
    return "\n".join(out) + "\n"


def materials(deck):
    entries = []
    for number, name in enumerate(("PINION", "GEAR"), 1):
        modulus, poisson = deck.materials[name]
        entries.append(
            {
                "model_part_name": f"Structure.{name}",
                "properties_id": number,
                "Material": {
                    "constitutive_law": {"name": "LinearElasticPlaneStrain2DLaw"},
                    "Variables": {"YOUNG_MODULUS": modulus, "POISSON_RATIO": poisson, "THICKNESS": 1.0, "DENSITY": 0.0},
                    "Tables": {},
                },
            }
        )
    return {"properties": entries}


def parameters(deck):
    pairs = range(1, deck.pairs() + 1)
    return {
        "problem_data": {"problem_name": "position", "parallel_type": "OpenMP", "start_time": 0.0, "end_time": 2.0, "echo_level": 0},
        "solver_settings": {
            "model_part_name": "Structure",
            "domain_size": 2,
            "solver_type": "Static",
            "echo_level": 1,
            "analysis_type": "non_linear",
            "model_import_settings": {"input_type": "mdpa", "input_filename": "position"},
            "material_import_settings": {"materials_filename": "materials.json"},
            "contact_settings": {"mortar_type": "ALMContactFrictionless", "silent_strategy": False},
            "time_stepping": {"time_step": 1.0},
            "compute_reactions": False,
            "convergence_criterion": "contact_residual_criterion",
            "residual_relative_tolerance": TOLERANCE,
            "displacement_relative_tolerance": TOLERANCE,
            "max_iteration": 40,
            "linear_solver_settings": {"solver_type": "LinearSolversApplication.sparse_lu"},
        },
        "processes": {
            "constraints_process_list": [
                {
                    "python_module": "assign_vector_variable_process",
                    "kratos_module": "KratosMultiphysics",
                    "Parameters": {"model_part_name": "Structure.HELD", "variable_name": "DISPLACEMENT", "constrained": [True] * 3, "value": [0.0] * 3},
                }
            ],
            "contact_process_list": [
                {
                    "python_module": "alm_contact_process",
                    "kratos_module": "KratosMultiphysics.ContactStructuralMechanicsApplication",
                    "Parameters": {
                        "model_part_name": "Structure",
                        "contact_model_part": {str(p - 1): [f"CONTACT_{p}"] for p in pairs},
                        "assume_master_slave": {str(p - 1): [f"SLAVE_{p}"] for p in pairs},
                        "contact_type": "Frictionless",
                        # its own choice, boxes around edges, misses pieces of flanks that overlap; so does a smaller radius at the edge of a contact
                        "search_parameters": {"type_search": "in_radius", "search_factor": 10.0},
                    },
                }
            ],
        },
    }


class Position(StructuralMechanicsAnalysis):
    def __init__(self, model, settings, deck):
        self.deck, self.iterations, self.converged = deck, 0, True
        super().__init__(model, settings)

    def ApplyBoundaryConditions(self):
        if self.time < 1.5:
            self.turn()
        else:
            self.release()
        super().ApplyBoundaryConditions()

    def turn(self):
        """All of the pinion turned by the deck's angle, its bore held there: so the search finds flanks that overlap."""
        part = self.model["Structure"]
        for node in part.GetSubModelPart("PINION").Nodes:
            x, y = self.deck.nodes[node.Id]
            node.SetSolutionStepValue(KM.DISPLACEMENT, 0, [-self.deck.angle * y, self.deck.angle * x, 0.0])
        for number in self.deck.bore:
            for variable in (KM.DISPLACEMENT_X, KM.DISPLACEMENT_Y):
                part.GetNode(number).Fix(variable)
        turning = part.GetNode(self.deck.turning)
        turning.SetSolutionStepValue(KM.DISPLACEMENT_X, 0, self.deck.angle)
        turning.Fix(KM.DISPLACEMENT_X)
        turning.Fix(KM.DISPLACEMENT_Y)

    def release(self):
        """The bore free, its nodes tied to the turning node, and the torque on that."""
        part = self.model["Structure"]
        turning = part.GetNode(self.deck.turning)
        turning.Free(KM.DISPLACEMENT_X)
        turning.SetSolutionStepValue(SMA.POINT_LOAD, 0, [self.deck.torque, 0.0, 0.0])
        number = 0
        for name in self.deck.bore:
            node, (x, y) = part.GetNode(name), self.deck.nodes[name]
            for variable, weight in ((KM.DISPLACEMENT_X, -y), (KM.DISPLACEMENT_Y, x)):
                node.Free(variable)
                number += 1
                part.CreateNewMasterSlaveConstraint("LinearMasterSlaveConstraint", number, turning, KM.DISPLACEMENT_X, node, variable, weight, 0.0)

    def SolveSolutionStep(self):
        done = super().SolveSolutionStep()
        self.converged &= done
        return done

    def FinalizeSolutionStep(self):
        self.iterations += self.model["Structure"].ProcessInfo[KM.NL_ITERATION_NUMBER]
        super().FinalizeSolutionStep()


def forces(deck, part, flank):
    """Contact force at the nodes along a flank of the gear, N/mm, and the length of flank that belongs to each. A node's force is its multiplier times the
    length over which Kratos has integrated it, which is shorter where its search missed a piece of the mate, and at the end of that."""
    nodes = deck.along(flank)
    force = []
    for number in nodes:
        node = part.GetNode(number)
        pressure = -node.GetValue(CSMA.AUGMENTED_NORMAL_CONTACT_PRESSURE) if node.Is(KM.ACTIVE) else 0.0
        force.append(pressure * node.GetValue(KM.NODAL_AREA) if pressure else 0.0)
    x = [deck.nodes[n] for n in nodes]
    edges = [0.0, *(((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5 for a, b in zip(x, x[1:])), 0.0]
    return force, [0.5 * (a + b) for a, b in zip(edges, edges[1:])]


def even(pressure):
    """Without the sawtooth from corner to middle node that an even pressure leaves on straight halves of a quadratic edge: its nodal forces are there as
    1 to 4 to 1, the halves' as 1 to 2 to 1."""
    ends = [0.0, *pressure, 0.0]
    return [0.25 * a + 0.5 * b + 0.25 * c for a, b, c in zip(ends, ends[1:], ends[2:])]


def answer(deck, part, iterations):
    """What is compared: turn, peak pressure, load of every pair."""
    loads, peak, raw = [], 0.0, 0.0
    quadratic = len(next(iter(deck.elements["GEAR"].values()))) == 6
    for pair in range(1, deck.pairs() + 1):
        force, lengths = forces(deck, part, f"GEAR_{pair}")
        pressure = [f / length for f, length in zip(force, lengths)]
        raw = max(raw, *pressure)
        peak = max(peak, *(even(pressure) if quadratic else pressure))
        loads.append(sum(force))
    return {
        "turn_urad": 1e6 * part.GetNode(deck.turning).GetSolutionStepValue(KM.DISPLACEMENT_X),
        "peak_pressure": peak,
        "largest_nodal_pressure": raw,
        "line_loads": loads,
        "iterations": iterations,
        "version": KM.Kernel.Version().split("-")[0].replace('"', ""),
    }


def main():
    deck = Deck(Path(sys.argv[1]))
    target = Path(sys.argv[2])
    Path("position.mdpa").write_text(mdpa(deck))
    Path("materials.json").write_text(json.dumps(materials(deck)))
    model = KM.Model()
    analysis = Position(model, KM.Parameters(json.dumps(parameters(deck))), deck)
    analysis.Run()
    if not analysis.converged:
        sys.exit("Kratos did not converge")
    target.write_text(json.dumps(answer(deck, model["Structure"], analysis.iterations)))


if __name__ == "__main__":
    main()
