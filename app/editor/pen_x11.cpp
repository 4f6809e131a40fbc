// Tablet pens through XInput 2: raw events on a separate connection, so that GLFW's is unaffected.
#include <X11/Xlib.h>
#include <X11/extensions/XInput2.h>

#include <map>

#include "app/editor/pen.h"

namespace weft {
namespace {

class X11Pen final : public PenSource {
  public:
    explicit X11Pen(Display* display, int opcode) : display_(display), opcode_(opcode) {
        unsigned char bits[XIMaskLen(XI_LASTEVENT)] = {};
        XISetMask(bits, XI_RawMotion);
        XISetMask(bits, XI_HierarchyChanged);
        XIEventMask mask;
        mask.deviceid = XIAllDevices;
        mask.mask_len = sizeof bits;
        mask.mask = bits;
        XISelectEvents(display_, DefaultRootWindow(display_), &mask, 1);
        XFlush(display_);
        look_for_pens();
    }
    ~X11Pen() override { XCloseDisplay(display_); }
    X11Pen(const X11Pen&) = delete;
    X11Pen& operator=(const X11Pen&) = delete;

    [[nodiscard]] std::optional<float> pressure() override {
        while (XPending(display_) > 0) {
            XEvent event;
            XNextEvent(display_, &event);
            XGenericEventCookie& cookie = event.xcookie;
            if (cookie.type != GenericEvent || cookie.extension != opcode_ ||
                !XGetEventData(display_, &cookie))
                continue;
            if (cookie.evtype == XI_HierarchyChanged) look_for_pens();
            if (cookie.evtype == XI_RawMotion) take(*static_cast<XIRawEvent*>(cookie.data));
            XFreeEventData(display_, &cookie);
        }
        return pens_.pressure();
    }

  private:
    void look_for_pens() {
        pens_.clear();
        const Atom wanted = XInternAtom(display_, "Abs Pressure", True);
        if (wanted == None) return;  // no driver has defined this axis
        int count = 0;
        XIDeviceInfo* devices = XIQueryDevice(display_, XIAllDevices, &count);
        for (int k = 0; k < count; ++k) {
            const XIDeviceInfo& device = devices[k];
            for (int i = 0; i < device.num_classes; ++i) {
                if (device.classes[i]->type != XIValuatorClass) continue;
                const auto& value = *reinterpret_cast<XIValuatorClassInfo*>(device.classes[i]);
                if (value.label == wanted)
                    pens_.add(device.deviceid, value.number, value.min, value.max);
            }
        }
        if (devices) XIFreeDeviceInfo(devices);
    }

    void take(const XIRawEvent& raw) {
        std::map<int, double> values;
        const double* next = raw.raw_values;
        for (int k = 0; k < 8 * raw.valuators.mask_len; ++k)
            if (XIMaskIsSet(raw.valuators.mask, k)) values[k] = *next++;
        // Events of a slave device carry its own number.
        pens_.report(raw.sourceid, values);
    }

    Display* display_;
    int opcode_;
    PenDevices pens_;
};

}  // namespace

std::unique_ptr<PenSource> open_pen() {
    Display* display = XOpenDisplay(nullptr);
    if (!display) return nullptr;
    int opcode = 0, event = 0, error = 0, major = 2, minor = 2;
    if (!XQueryExtension(display, "XInputExtension", &opcode, &event, &error) ||
        XIQueryVersion(display, &major, &minor) != Success) {
        XCloseDisplay(display);
        return nullptr;
    }
    return std::make_unique<X11Pen>(display, opcode);
}

}  // namespace weft
