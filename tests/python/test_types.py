"""The classes of the module: their stubs, and objects that were never initialized."""

import ast
import pathlib
import re

import pytest

import glissade

CLASSES = [each for each in vars(glissade).values() if isinstance(each, type)]
STUBS = ast.parse(pathlib.Path(glissade.__file__).with_suffix(".pyi").read_text()).body


def members(cls):
    """The names of the members that need an object."""
    own = [name for name in dir(cls) if not hasattr(object, name) or (name == "__repr__" and name in vars(cls))]
    return [name for name in own if not isinstance(vars(cls).get(name), staticmethod)]


@pytest.mark.parametrize("cls", CLASSES)
def test_an_object_without_init_raises(cls):
    made = cls.__new__(cls)
    for name in members(cls):
        with pytest.raises((TypeError, RuntimeError)):
            value = getattr(made, name)
            value()


@pytest.mark.parametrize("cls", CLASSES)
def test_a_subclass_that_forgets_init_raises(cls):
    class Forgetful(cls):
        def __init__(self):
            pass

    with pytest.raises(TypeError, match="__init__"):
        Forgetful()


def test_an_object_without_init_is_no_argument():
    def raw(cls):
        return cls.__new__(cls)

    tree = glissade.Tree(glissade.Mesh.shape("box"))
    scene = glissade.Scene()
    for call in [
        lambda: glissade.Tree(raw(glissade.Mesh)),
        lambda: glissade.distance(tree, raw(glissade.Tree), [0, 0, 0, 1, 0, 0, 0]),
        lambda: glissade.Pipeline(threads=1).add(raw(glissade.Tree)),
        lambda: glissade.Simulation(raw(glissade.Scene)),
        lambda: scene.add("a", raw(glissade.Mesh)),
        lambda: setattr(scene, "rules", raw(glissade.SlidingRules)),
        lambda: setattr(scene, "hands", [raw(glissade.HandShape)]),
        lambda: glissade.HapticServer(scene, raw(glissade.SimulatedGlove)),
        lambda: glissade.HapticServer(scene, raw(glissade.Glove)),
        *[lambda cls=cls: glissade.view(raw(cls)) for cls in
          [glissade.Scene, glissade.Simulation, glissade.HapticServer, glissade.Recording]],
    ]:
        with pytest.raises((TypeError, RuntimeError)):
            call()


def test_subclasses_that_initialize_work():
    class Named(glissade.Mesh):
        def __init__(self, name, mesh):
            super().__init__(mesh.vertices, mesh.triangles)
            self.name = name

    assert glissade.Tree(Named("box", glissade.Mesh.shape("box"))).radius > 0


@pytest.mark.parametrize("name", glissade.__all__)
def test_everything_belongs_to_the_package_and_has_a_docstring(name):
    thing = getattr(glissade, name)
    if not callable(thing):
        return
    assert thing.__module__ == "glissade" and "_glissade" not in thing.__doc__
    for member in vars(thing) if isinstance(thing, type) else []:
        if member[0] == "_":
            continue
        doc = getattr(thing, member).__doc__ or ""
        assert "_glissade" not in doc and re.sub(rf"^{member}\(.*\n", "", doc).strip(), member


def stub_functions():
    """Name, and the definition in the stubs, of each function and method."""
    for node in STUBS:
        if isinstance(node, ast.FunctionDef):
            yield node.name, node
        elif isinstance(node, ast.ClassDef):
            for each in node.body:
                if isinstance(each, ast.FunctionDef) and not any(
                    isinstance(d, ast.Attribute) or d.id != "staticmethod" for d in each.decorator_list
                ):
                    yield f"{node.name}.{each.name}", each


def arguments_in_stub(function):
    """Name and default, '' for none, of each argument; '...' stands for any default."""
    arguments = function.args
    defaults = [None] * (len(arguments.args) - len(arguments.defaults)) + arguments.defaults
    result = [(a.arg, d) for a, d in zip(arguments.args, defaults)] + list(zip([a.arg for a in arguments.kwonlyargs], arguments.kw_defaults))
    return [(name, ast.unparse(default) if default else "") for name, default in result if name != "self"]


def arguments_at_run_time(name):
    """The same from the docstring, where pybind11 writes the signature."""
    found = glissade
    for part in name.split("."):
        found = getattr(found, part)
    signature = found.__doc__.splitlines()[0]
    inner = signature[signature.index("(") + 1 : signature.rindex(")")]
    result = []
    for argument in re.split(r", (?![^\[(]*[\])])", inner):
        match = re.match(r"(\w+): [^=]*(?: = (.*))?$", argument)
        if match and match[1] != "self":
            result.append((match[1], match[2] or ""))
    return result


@pytest.mark.parametrize("name, function", list(stub_functions()))
def test_stubs_have_the_arguments_and_defaults_of_the_module(name, function):
    if name.split(".")[-1] in ("__enter__", "__len__", "_repr_html_"):
        return
    in_stub, at_run_time = arguments_in_stub(function), arguments_at_run_time(name)
    assert [argument for argument, _ in in_stub] == [argument for argument, _ in at_run_time]
    for (argument, default), (_, actual) in zip(in_stub, at_run_time):
        assert (default == "") == (actual == ""), argument
        if default not in ("", "..."):
            assert ast.literal_eval(default) == ast.literal_eval(actual), argument
