"""What a module of the package asks of another one of it exists there. Needs neither the package installed nor pytest: `python python/tests/test_names.py`."""

import ast
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent / "gearwear"


def defined(tree):
    """Names at the top of a module."""
    names = set()
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names.update(target.id for target in targets if isinstance(target, ast.Name))
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            names.update((alias.asname or alias.name).split(".")[0] for alias in node.names)
    return names


def missing():
    trees = {path.stem: ast.parse(path.read_text(encoding="utf-8")) for path in PACKAGE.glob("*.py")}
    known = {name: defined(tree) for name, tree in trees.items()}
    for name, tree in trees.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id in known:
                if node.attr not in known[node.value.id]:
                    yield f"{name}.py:{node.lineno}: {node.value.id}.{node.attr}"
            if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module in known:
                for alias in node.names:
                    if alias.name not in known[node.module]:
                        yield f"{name}.py:{node.lineno}: from .{node.module} import {alias.name}"


def test_names_asked_of_other_modules_exist():
    found = list(missing())
    assert not found, found


if __name__ == "__main__":
    test_names_asked_of_other_modules_exist()
