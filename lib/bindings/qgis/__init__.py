"""Sightline in QGIS: a provider of algorithms for Processing."""


def classFactory(iface):  # the name that QGIS asks for
    from .provider import Plugin
    return Plugin()
