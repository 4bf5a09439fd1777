/* A module for Debian's X.Org server. It gives the screens of the driver "dummy", which exist in memory only, a
 * monitor that DPMS can switch off. Neither that driver nor Xvfb has one.
 *
 * The server loads all modules, then probes, then starts the screens. So the module adds a driver that claims no
 * device. When the server probes it, it takes the place of the dummy's probe, and this in turn that of the screens'
 * start. */

#include <xorg-server.h>

#include <string.h>
#include <xf86.h>
#include <xf86Module.h>

/* The server exports them, but its public headers do not declare them. */
extern DriverPtr *xf86DriverList;
extern int xf86NumDrivers;
extern int xf86NumScreens;

static xf86ProbeProc *dummyProbe;
static xf86ScreenInitProc *dummyStart;

static void setPower(ScrnInfoPtr screen, int level, int flags) {
  (void)flags;
  xf86DrvMsg(screen->scrnIndex, X_INFO, "the monitor's power level is %d\n", level);
}

static Bool start(ScreenPtr screen, int argc, char **argv) {
  return dummyStart(screen, argc, argv) && xf86DPMSInit(screen, setPower, 0);
}

static Bool probeDummy(DriverPtr driver, int flags) {
  const Bool found = dummyProbe(driver, flags);
  for (int i = 0; found && i < xf86NumScreens; ++i) {
    if (xf86Screens[i]->ScreenInit == start) continue;
    dummyStart = xf86Screens[i]->ScreenInit;
    xf86Screens[i]->ScreenInit = start;
  }
  return found;
}

static Bool probe(DriverPtr driver, int flags) {
  (void)driver, (void)flags;
  for (int i = 0; i < xf86NumDrivers; ++i) {
    DriverPtr other = xf86DriverList[i];
    if (!other || strcmp(other->driverName, "dummy") != 0 || other->Probe == probeDummy) continue;
    dummyProbe = other->Probe;
    other->Probe = probeDummy;
  }
  return FALSE; /* it claims no device */
}

static DriverRec monitor = {.driverVersion = 1, .driverName = "monitor", .Probe = probe};

static void *setUp(void *module, void *options, int *major, int *minor) {
  static Bool added = FALSE;
  (void)module, (void)options, (void)major, (void)minor;
  if (!added) xf86AddDriver(&monitor, NULL, 0); /* with its module named, the server would unload this code */
  added = TRUE;
  return &monitor;
}

static XF86ModuleVersionInfo version = {.modname = "monitor",
                                        .vendor = MODULEVENDORSTRING,
                                        ._modinfo1_ = MODINFOSTRING1,
                                        ._modinfo2_ = MODINFOSTRING2,
                                        .xf86version = XORG_VERSION_CURRENT,
                                        .majorversion = 1,
                                        .abiclass = ABI_CLASS_VIDEODRV,
                                        .abiversion = ABI_VIDEODRV_VERSION,
                                        .moduleclass = MOD_CLASS_NONE};

_X_EXPORT XF86ModuleData monitorModuleData = {&version, setUp, NULL};
