"""Names of the package: a module of the same name would take the place of a function once it is imported."""

import pkgutil

import hypofab


def test_no_public_name_is_that_of_a_module() -> None:
    modules = {module.name for module in pkgutil.iter_modules(hypofab.__path__)}
    assert "results" in modules
    assert not modules & set(hypofab.__all__)
